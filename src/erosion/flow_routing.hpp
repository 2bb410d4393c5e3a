#pragma once
// Where water runs from each sample when it takes one way only, and the order in which samples must
// be visited so that everything upstream of one is done before it.
//
//   receiver(k) = the neighbour n of the 8 with the greatest (h_k - h_n) / d_kn > 0      (D8)
//
// d is 1 cell or √2 cells. Between equal slopes the first counter-clockwise from east is taken. A
// sample without a lower neighbour lets its water out of the map if it lies on the border, else it
// is a pit and the water stays. (O'Callaghan and Mark, "The extraction of drainage networks from
// digital elevation data", 1984.)
//
// The order is found in O(n): from each sample without donors one walks downstream until a sample
// waits for another donor (Zhou, Wei, Fu, "A fast and simple algorithm for calculating flow
// accumulation matrices", 2019). Bands of rows do so at once on many threads; what lies downstream
// of a border between bands, the trunk, comes last on one thread.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/grid.hpp"
#include "base/parallel.hpp"
#include "base/progress.hpp"

namespace wold {

/// Neighbours 0 to 7, counter-clockwise from east.
inline constexpr std::array<int, 8> flow_dx{1, 1, 0, -1, -1, -1, 0, 1};
inline constexpr std::array<int, 8> flow_dy{0, 1, 1, 1, 0, -1, -1, -1};

/// What a direction is beside a neighbour's number.
inline constexpr std::uint8_t flow_stops = 8;   ///< a pit: the water stays
inline constexpr std::uint8_t flow_leaves = 9;  ///< the water leaves the map

/// The opposite of a neighbour's number.
constexpr int opposite_flow(int direction) {
  return (direction + 4) & 7;
}
/// Distance to a neighbour, cells.
constexpr double flow_distance(int direction) {
  return (direction & 1) != 0 ? 1.41421356237309504880 : 1.0;
}
/// By how much the place in `values()` of a neighbour differs.
constexpr int flow_step(int direction, int width) {
  return flow_dy[static_cast<std::size_t>(direction)] * width +
         flow_dx[static_cast<std::size_t>(direction)];
}

/// Sides of a field, as where something may pass.
struct Sides {
  bool west = false;
  bool east = false;
  bool south = false;
  bool north = false;

  /// Whether sample (i, j) of a grid of that size lies on one of them.
  bool hold(int i, int j, int width, int height) const {
    return (west && i == 0) || (east && i == width - 1) || (south && j == 0) ||
           (north && j == height - 1);
  }
};
inline constexpr Sides all_sides{true, true, true, true};

/// For each sample the number of the neighbour that takes its water, `flow_stops` or `flow_leaves`.
Grid<std::uint8_t> d8_directions(const Grid<float>& height, Progress& progress);

/// Which neighbours give their water to each sample: a bit for each, by its number.
void donor_masks(const Grid<std::uint8_t>& direction, Grid<std::uint8_t>& mask, Progress& progress);

/// Samples, as places in `values()`, such that all that is upstream of one comes before it.
class FlowOrder {
 public:
  FlowOrder() = default;
  /// `direction` must hold no cycle.
  FlowOrder(const Grid<std::uint8_t>& direction, Progress& progress);

  /// Finds the order anew, keeping memory. `amounts` holds what each sample adds of its own and
  /// becomes the sum with all upstream; of an integer type, so that no order matters.
  void build(const Grid<std::uint8_t>& direction, std::span<std::int32_t> amounts,
             Progress& progress);
  void build(const Grid<std::uint8_t>& direction, std::span<std::int64_t> amounts,
             Progress& progress);
  /// Samples that no band could do alone.
  std::size_t trunk_size() const { return trunk_.size(); }

  /// Calls `visit(k)` once for each sample, after it was called for all its donors; on any thread.
  /// It should write nowhere but at k.
  template <class Visit>
  void upstream_first(const Visit& visit) const {
    parallel_for(0, bands(), [&](int b) {
      for (const int k : band(b)) visit(k);
    });
    for (const int k : trunk_) visit(k);
  }

  /// Calls `visit(k)` once for each sample, after it was called for the one that takes its water.
  template <class Visit>
  void downstream_first(const Visit& visit) const {
    for (auto k = trunk_.rbegin(); k != trunk_.rend(); ++k) visit(*k);
    parallel_for(0, bands(), [&](int b) {
      const std::span<const int> nodes = band(b);
      for (auto k = nodes.rbegin(); k != nodes.rend(); ++k) visit(*k);
    });
  }

 private:
  template <class Amount>
  void build_with(const Grid<std::uint8_t>& direction, std::span<Amount> amounts,
                  Progress& progress);
  int bands() const { return static_cast<int>(bands_.size()); }
  std::span<const int> band(int b) const { return bands_[static_cast<std::size_t>(b)]; }

  std::vector<std::vector<int>> bands_;
  std::vector<int> trunk_;
  Grid<std::uint8_t> donors_;
  Grid<std::uint8_t> waiting_;
};

/// Σ of `own(k)` over a sample and all upstream of it; the same bits for any number of threads.
template <class Own>
Grid<double> accumulate_flow(const Grid<std::uint8_t>& direction, const FlowOrder& order,
                             const Own& own);

/// Upstream area of each sample with itself, m².
Grid<double> d8_area(const Grid<std::uint8_t>& direction, const FlowOrder& order, double cell);

/// Calls `visit(n)` for each donor n of sample k, by their numbers as neighbours.
template <class Visit>
void each_donor(const Grid<std::uint8_t>& direction, int k, const Visit& visit) {
  const int width = direction.width();
  const int i = k % width;
  const int j = k / width;
  for (int d = 0; d < 8; ++d) {
    const int x = i + flow_dx[static_cast<std::size_t>(d)];
    const int y = j + flow_dy[static_cast<std::size_t>(d)];
    if (x < 0 || y < 0 || x >= width || y >= direction.height()) continue;
    const int n = y * width + x;
    if (direction.values()[static_cast<std::size_t>(n)] == opposite_flow(d)) visit(n);
  }
}

template <class Own>
Grid<double> accumulate_flow(const Grid<std::uint8_t>& direction, const FlowOrder& order,
                             const Own& own) {
  Grid<double> sum(direction.width(), direction.height());
  const std::span<double> out = sum.values();
  order.upstream_first([&](int k) {
    double s = own(k);
    each_donor(direction, k, [&](int n) { s += out[static_cast<std::size_t>(n)]; });
    out[static_cast<std::size_t>(k)] = s;
  });
  return sum;
}

}  // namespace wold
