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
constexpr double margin_share = 0.04;  ///< of the domain: what reaches no further is a margin
constexpr double smoothing = 2;        ///< of a coarser grid's ground, cells
constexpr double level_share = 0.6;    ///< of the years left
constexpr int first_steps = 40;
constexpr int further_steps = 16;

/// South-west and north-east corners, m.
struct Corners {
  DVec2 low;
  DVec2 high;
};

/// Those of `input`, or of `domain` where they are near: so a margin of some samples, in which
/// resolutions differ, moves nothing.
Corners corners_of(const Heightfield& input, const TerrainDomain& domain) {
  const auto settled = [&](DVec2 corner, DVec2 of_domain) {
    for (int axis = 0; axis < 2; ++axis)
      if (std::abs(corner[axis] - of_domain[axis]) < margin_share * domain.size[axis])
        corner[axis] = of_domain[axis];
    return corner;
  };
  return {settled(input.origin, domain.origin),
          settled(input.origin + input.size(), domain.origin + domain.size)};
}

/// The samples of a lattice of that cell through the corner of `domain` that best cover `corners`.
Heightfield lattice_over(const Corners& corners, const TerrainDomain& domain, double cell) {
  const DVec2 first = glm::round((corners.low - domain.origin) / cell);
  const DVec2 last = glm::round((corners.high - domain.origin) / cell);
  const auto samples = [](double from, double to) {
    return std::max(1, static_cast<int>(to - from)) + 1;
  };
  return {Grid<float>(samples(first.x, last.x), samples(first.y, last.y)),
          domain.origin + cell * first, cell};
}

/// What of `input` lies over `grid`; at least the samples nearest to it.
Heightfield part_over(const Heightfield& input, const Heightfield& grid) {
  const IVec2 most(input.height.width() - 1, input.height.height() - 1);
  const auto sample_at = [&](DVec2 place) {
    return glm::clamp(IVec2(glm::round((place - input.origin) / input.cell)), IVec2(0), most);
  };
  const IVec2 first = sample_at(grid.origin);
  const IVec2 last = sample_at(grid.origin + grid.size());
  Heightfield part{Grid<float>(last.x - first.x + 1, last.y - first.y + 1),
                   place_of(input, first.x, first.y), input.cell};
  for (int j = 0; j < part.height.height(); ++j)
    std::copy_n(input.height.row(first.y + j).begin() + first.x, part.height.width(),
                part.height.row(j).begin());
  return part;
}

/// `finer` at the samples of `coarser`, smoothed by a Gaussian of `deviation` metres.
Grid<float> smoothed_over(const Heightfield& finer, const Heightfield& coarser, double deviation,
                          Progress& progress) {
  const Heightfield smooth{blurred(finer.height, deviation / finer.cell, progress, Outside::mirror),
                           finer.origin, finer.cell};
  return map_grid<float>(coarser, progress, [&](int i, int j) {
    return ground_at(smooth, place_of(coarser, i, j)).height;
  });
}

/// The input on the coarser grids, each smoothed by a Gaussian of `smoothing` of its cells: it
/// must be the same whatever the input's resolution, for small differences on flat ground would
/// lead rivers elsewhere.
void fill_grounds(std::vector<StreamPowerLevel>& levels, const Heightfield& input,
                  Progress& progress) {
  if (levels.empty()) return;
  Heightfield& finest = levels.back().ground;
  finest.height =
      smoothed_over(part_over(input, finest), finest, smoothing * finest.cell, progress);
  for (std::size_t l = levels.size() - 1; l-- > 0;) {
    const Heightfield& finer = levels[l + 1].ground;
    const double further = std::sqrt(std::pow(levels[l].ground.cell, 2) - std::pow(finer.cell, 2));
    levels[l].ground.height = smoothed_over(finer, levels[l].ground, smoothing * further, progress);
  }
}

}  // namespace

Grid<float> regridded(const Grid<float>& map, const Heightfield& from, const Heightfield& to,
                      Progress& progress) {
  return resample(map, {from.origin, from.size()}, Outside::clamp, to, progress);
}

std::vector<StreamPowerLevel> stream_power_levels(const Heightfield& input,
                                                  const TerrainDomain& domain, double years,
                                                  std::uint64_t seed, Progress& progress) {
  const auto longer = [](DVec2 size) { return std::max(size.x, size.y); };
  double cell = longer(domain.size) / base_cells;
  cell *= std::exp2(std::round(std::log2(longer(input.size()) / longer(domain.size))));
  const Corners corners = corners_of(input, domain);
  std::vector<StreamPowerLevel> levels;
  for (; cell > 1.41 * input.cell; cell /= 2)
    levels.push_back({.ground = lattice_over(corners, domain, cell)});
  fill_grounds(levels, input, progress);
  levels.push_back({.ground = input});
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
