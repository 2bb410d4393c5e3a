#pragma once
// The stream-power law on one grid, stepped in time.
//
//   ∂h/∂t = U - K A^m S^n                                            on slopes up to the talus
//   angle
//
// h height (m), t time (years), U uplift (m/yr), K erodibility (m^(1-2m)/yr), A upstream area (m²;
// with a map of rain, area times rain), S slope to the receiver.
//
// A step Δt is implicit and solved in O(n), receivers first (Braun and Willett, "A very efficient
// O(n), implicit and parallel method to solve the stream power equation", 2013):
//
//   h' = (h + U Δt + F h'_r) / (1 + F),  F = K A^m Δt / d                               n = 1
//   h' - h - U Δt + F (h' - h'_r)^n = 0,  F = K A^m Δt / d^n                            Newton
//
// where r is the receiver at distance d. It is stable for any Δt, and first-order accurate: knicks
// in a profile are smeared over the way K A^m Δt that they move in a step. Then h' is held to
// h'_r + d tan(talus): what would stand steeper falls and is carried off by the stream. Water
// crosses depressions (flow_routing_pits.hpp) and leaves their ground as it is.
//
// With deposition, of the load q that leaves a sample in a step (m over its area) G q cell² / A is
// laid down there from A = 2000 m² on where the ground is not too steep (Davy and Lague, 2009;
// Yuan, Braun, Guerit, Rouby, Cordonnier, "A new efficient method to solve the stream power law
// model taking into account sediment deposition", 2019; here explicit, after the erosion of the
// step), but only up to half the way to the lowest donor; in depressions as much as there is room
// for. In balance S then is (1 + G)^(1/n) times as great.
//
// So that rivers do not run along the axes, samples are thought of as shifted from the grid, each
// by a random vector of up to `shift` cells (stream_power_mesh.hpp): the receiver is the neighbour
// with the steepest slope over the distance between shifted samples.

#include <cstdint>

#include "erosion/flow_routing.hpp"
#include "erosion/flow_routing_pits.hpp"
#include "erosion/hillslope_solver.hpp"
#include "erosion/stream_power_directions.hpp"
#include "erosion/stream_power_mesh.hpp"

namespace wold {

struct StreamPowerLaw {
  double area_exponent = 0.45;  ///< m
  double slope_exponent = 1;    ///< n
  double deposition = 0;        ///< G
  double diffusivity = 0;       ///< κ of hillslopes, m²/yr
  double wandering = 0.5;       ///< of receivers, by chance, each step: 0 to 1
  Sides open = all_sides;
};

/// What may differ from sample to sample.
struct StreamPowerGround {
  Grid<float> erodibility;  ///< K
  Grid<float> uplift;       ///< U, m/yr
  Grid<float> talus;        ///< tan of the steepest slope
  Grid<std::int32_t> rain;  ///< in 1/256, or empty for 1 everywhere
};

class StreamPowerSolver {
 public:
  /// `mesh` tells distances; where it `is_real` heights are those at the shifted samples, else it
  /// only chooses receivers.
  StreamPowerSolver(double cell, const StreamPowerLaw& law, StreamPowerGround ground,
                    const StreamPowerMesh& mesh, std::uint64_t seed, Progress& progress);

  /// Steps on. `height` has the shape of the ground.
  void step(Grid<float>& height, double years);

  /// Of the last step.
  const Grid<std::uint8_t>& direction() const { return direction_; }
  Grid<float> area() const;  ///< m²
  /// Thickness of what streams laid down, m; empty without deposition. May be set before the first
  /// step.
  Grid<float>& sediment() { return sediment_; }
  int pits() const { return pits_; }
  std::size_t trunk_size() const { return order_.trunk_size(); }

 private:
  void find_directions(const Grid<float>& height);
  DirectionRow direction_row(const Grid<float>& height, int j) const;
  std::uint8_t border_direction(const Grid<float>& height, int i, int j) const;
  template <class Amount>
  void find_order(Grid<Amount>& amounts);
  template <class AreaPower>
  void erode(Grid<float>& height, double years, const AreaPower& area_power);
  void deposit(Grid<float>& height);
  float area_at(int k) const;  ///< m²

  double cell_;
  StreamPowerLaw law_;
  StreamPowerGround ground_;
  Progress& progress_;
  std::uint64_t seed_;
  int steps_ = 0;
  std::uint32_t step_key_ = 0;
  std::array<Grid<float>, 4> nearness_;  ///< 1 / distance to neighbours 0 to 3, per cell
  bool shifted_;
  Grid<float> cosine_;  ///< between the ways to receivers and the slope
  Grid<std::uint8_t> direction_;
  FlowOrder order_;
  PitRouter router_;

  Grid<double> load_;          ///< carried by the streams in the last step, m over a sample
  Grid<float> sediment_;       ///< m
  Grid<std::int32_t> count_;   ///< samples upstream
  Grid<std::int64_t> rain_;    ///< Σ rain upstream
  std::vector<float> powers_;  ///< area^m of small counts
  int pits_ = 0;
};

}  // namespace wold
