#include "erosion/stream_power_levels.hpp"

#include <algorithm>
#include <cmath>

#include "base/hash.hpp"
#include "terrain/blur.hpp"
#include "terrain/field_map.hpp"
#include "terrain/resample.hpp"

namespace wold {

namespace {

constexpr int base_cells = 64;
constexpr double level_share = 0.6;  ///< of the years left
constexpr int first_steps = 100;
constexpr int further_steps = 16;

/// A grid of that cell, or one a little smaller that fits west to east, over the extent of `input`.
Heightfield grid_over(const Heightfield& input, int cells_east) {
  const double cell = input.size().x / cells_east;
  const int cells_north = std::max(1, static_cast<int>(std::lround(input.size().y / cell)));
  return {Grid<float>(cells_east + 1, cells_north + 1), input.origin, cell};
}

/// The input on a coarser grid, smoothed by a Gaussian of the grid's cell: the same whatever
/// the input's resolution, for small differences on flat ground would lead rivers elsewhere.
Grid<float> smoothed_over(const Heightfield& input, const Heightfield& coarser,
                          Progress& progress) {
  const Heightfield smooth{blurred(input.height, 1.0 * coarser.cell / input.cell, progress),
                           input.origin, input.cell};
  return map_grid<float>(coarser, progress, [&](int i, int j) {
    return ground_at(smooth, place_of(coarser, i, j)).height;
  });
}

}  // namespace

Grid<float> regridded(const Grid<float>& map, const Heightfield& from, const Heightfield& to,
                      Progress& progress) {
  return resample(map, {from.origin, from.size()}, Outside::clamp, to, progress);
}

std::vector<StreamPowerLevel> stream_power_levels(const Heightfield& input, double years,
                                                  std::uint64_t seed, Progress& progress) {
  const DVec2 size = input.size();
  int cells_east =
      std::max(1, static_cast<int>(std::lround(base_cells * size.x / std::max(size.x, size.y))));
  std::vector<StreamPowerLevel> levels;
  for (; size.x / cells_east > 1.41 * input.cell; cells_east *= 2)
    levels.push_back({.ground = grid_over(input, cells_east)});
  levels.push_back({.ground = input});
  for (std::size_t l = 0; l + 1 < levels.size(); ++l)
    levels[l].ground.height = smoothed_over(input, levels[l].ground, progress);
  double left = 1;
  for (std::size_t l = 0; l < levels.size(); ++l) {
    const bool last = l + 1 == levels.size();
    const double share = last ? left : level_share * left;
    levels[l].years = share * years;
    levels[l].steps = l == 0 ? first_steps : last ? 2 * further_steps : further_steps;
    levels[l].mesh = StreamPowerMesh(levels[l].ground, random_bits(seed, l), !last);
    left -= share;
  }
  return levels;
}

}  // namespace wold
