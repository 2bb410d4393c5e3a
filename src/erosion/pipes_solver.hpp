#pragma once
// The pipe model on one grid, step by step. Equations in pipes.hpp.

#include <functional>
#include <vector>

#include "base/progress.hpp"
#include "erosion/ghost_grid.hpp"
#include "erosion/pipes.hpp"
#include "erosion/pipes_rows.hpp"

namespace wold::pipes_detail {

/// Sums over the whole grid, in grains.
struct GrainSums {
  std::int64_t water_in = 0;
  std::int64_t water_evaporated = 0;
  std::int64_t water_out = 0;     ///< over the border
  std::int64_t sediment_out = 0;  ///< over the border
  std::int64_t taken_up = 0;      ///< by water and by slides

  GrainSums& operator+=(const GrainSums& b);
};

/// What lies on and in the ground of one row, said before every slide.
struct MaterialRow {
  const float* ground;   ///< m, as it was at first
  const Grains* change;  ///< since
  float* ease;           ///< out: factor of what water takes up
  float* rise;           ///< out: distance (m) over which the ground may rise from 0 to its height
  float* tangent;        ///< out: of the steepest stable slope of the material on top
};
using MaterialFunction = std::function<void(int j, const MaterialRow& row)>;

/// What a solver starts from, all over the same samples.
struct PipeStart {
  Heightfield ground;
  Grid<float> ease;           ///< factor of what water takes up
  Grid<float> inflow;         ///< m/s
  Grid<Grains> change;        ///< of the ground so far
  Grid<Grains> depth;         ///< of water
  Grid<Grains> sediment;      ///< in the water
  MaterialFunction material;  ///< empty: one material everywhere
};

class PipeSolver {
 public:
  /// Throws Error(cancelled).
  PipeSolver(PipeStart start, const Pipes& parameters, Progress& progress);
  PipeSolver(const PipeSolver&) = delete;
  PipeSolver& operator=(const PipeSolver&) = delete;
  ~PipeSolver();

  /// Lets `seconds` pass, and advances the progress by them. Throws Error(cancelled), and
  /// Error(limit) for water deeper than the grains can count.
  void run(double seconds, Progress& progress);
  /// Taken so far.
  int steps() const { return steps_; }

  const Heightfield& ground() const { return start_.ground; }
  Grid<Grains> change() const { return copy_of(now_.change); }
  Grid<Grains> depth() const { return copy_of(now_.depth); }
  Grid<Grains> sediment() const { return copy_of(now_.sediment); }
  /// East and north, m/s; 0 where there is no water.
  Grid<float> velocity_x() const;
  Grid<float> velocity_y() const;
  /// Share of the time under at least a centimetre of water.
  Grid<float> wetness() const;
  const GrainSums& sums() const { return sums_; }

 private:
  struct Fields {
    GhostGrid<Grains> depth;
    GhostGrid<Grains> sediment;
    GhostGrid<Grains> change;
    GhostGrid<float> west;   ///< m²/s, through the western face of each cell and the last eastern
    GhostGrid<float> south;  ///< one row more than cells
    GhostGrid<float> speed_west;  ///< m/s, through the same faces; with momentum only
    GhostGrid<float> speed_south;
  };
  struct Band;

  static Grid<Grains> copy_of(const GhostGrid<Grains>& grid);
  int row_of(int j) const;
  int near_row(int j) const;
  void fill_sides_of_faces(GhostGrid<float>& faces, int j) const;
  RowState state(int j) const;
  double fastest_now(Progress& progress) const;  ///< m/s, for the step
  void step(double seconds, Progress& progress);
  void step_band(Band& band);
  void drive_x(Band& band, int j);
  void drive_inner_x(Band& band, int j);
  void drive_y(Band& band, int face);
  void drive_inner_y(Band& band, int face);
  void limit_row(Band& band, int j) const;
  void pass_y(Band& band, int face, bool owner);
  void finish_row(Band& band, int j);
  /// An open border wears no lower than the ground beside it: nothing beyond it pulls it down.
  void hold_border(Band& band, int j);
  void let_rain(double seconds, Progress& progress);
  void let_slide(double seconds, Progress& progress);
  void prepare_slide(int j, float stir_per_discharge);
  SlideState slide_state(int j) const;
  void fill_ends(Fields& fields) const;

  Pipes parameters_;
  PipeStart start_;
  int width_ = 0;
  int height_ = 0;
  bool periodic_ = false;
  StepConstants constants_;
  GhostGrid<float> ground_;
  GhostGrid<float> ease_;
  Fields now_;
  Fields next_;
  GhostGrid<float> rise_;
  GhostGrid<float> tangent_;
  GhostGrid<float> stir_;
  GhostGrid<Grains> slid_;  ///< change when the ground slid last
  Grid<float> wet_time_;    ///< s
  double time_ = 0;         ///< s
  int steps_ = 0;
  int rains_ = 0;
  std::vector<Band> bands_;
  GrainSums sums_;
};

}  // namespace wold::pipes_detail
