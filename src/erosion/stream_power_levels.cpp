#include "erosion/stream_power_levels.hpp"

#include <algorithm>
#include <cmath>

#include "base/hash.hpp"
#include "terrain/resample.hpp"

namespace wold {

namespace {

constexpr int base_cells = 64;
constexpr double first_share = 0.6;  ///< of the years
constexpr int first_steps = 100;
constexpr int further_steps = 16;

/// A grid of that cell, or one a little smaller that fits west to east, over the extent of `input`.
Heightfield grid_over(const Heightfield& input, int cells_east) {
  const double cell = input.size().x / cells_east;
  const int cells_north = std::max(1, static_cast<int>(std::lround(input.size().y / cell)));
  return {Grid<float>(cells_east + 1, cells_north + 1), input.origin, cell};
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
  for (std::size_t l = levels.size() - 1; l-- > 0;) {
    const Heightfield& finer = levels[l + 1].ground;
    Heightfield& coarser = levels[l].ground;
    coarser.height = regridded(finer.height, finer, coarser, progress);
  }
  double left = 1;
  for (std::size_t l = 0; l < levels.size(); ++l) {
    const bool last = l + 1 == levels.size();
    const double share = last ? left : l == 0 ? first_share : left / 2;
    levels[l].years = share * years;
    levels[l].steps = l == 0 ? first_steps : last ? 2 * further_steps : further_steps;
    levels[l].mesh = StreamPowerMesh(levels[l].ground, random_bits(seed, l), !last);
    left -= share;
  }
  return levels;
}

}  // namespace wold
