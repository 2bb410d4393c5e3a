#include "render/water.hpp"

#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"

namespace wold {

namespace {

constexpr float nowhere = -1e9F;
constexpr int shore_samples = 3;
// Dry ground that is lower than the water beside it lies so many cells above the level there, so
// that no water shows between its samples.
constexpr float dry_step = 0.25F;

/// Dry samples beside water take the mean level of their neighbours that have one, if their own
/// ground is higher.
Grid<float> spread(const Grid<float>& level, const Heightfield& bed) {
  const float step = dry_step * static_cast<float>(bed.cell);
  Grid<float> out = level;
  parallel_for(0, level.height(), [&](int j) {
    for (int i = 0; i < level.width(); ++i) {
      if (level(i, j) > nowhere) continue;
      float sum = 0;
      int count = 0;
      for (int dj = -1; dj <= 1; ++dj)
        for (int di = -1; di <= 1; ++di) {
          const float l = level.clamped(i + di, j + dj);
          if (l <= nowhere) continue;
          sum += l;
          ++count;
        }
      if (count == 0) continue;
      const float mean = sum / static_cast<float>(count);
      const float ground = bed.height(i, j);
      // Rounding must not make the shore itself dry.
      out(i, j) = ground > mean - 0.01F * step ? mean : ground - step;
    }
  });
  return out;
}

}  // namespace

Description<WaterSettings> describe(const WaterSettings&) {
  using W = WaterSettings;
  return Description<W>("water", "Lakes and rivers: a surface at the level that a map gives.")
      .add("depth", &W::depth, "A map of depths in m, such as rivers.water; none: no water.")
      .add("least_depth", &W::least_depth, {.unit = "m", .min = 0, .max = 100},
           "Thinner water is left out.")
      .add("color", &W::color, {.min = 0, .max = 1}, "Of deep water, linear Rec. 709.")
      .add("clarity", &W::clarity, {.unit = "m", .min = 0.001, .max = 1000},
           "Depth at which a third of the bed still shows.")
      .add("roughness", &W::roughness, {.min = 0.01, .max = 1}, "Of the surface's reflections.")
      .add("ripples", &W::ripples, {.min = 0, .max = 0.5}, "Slope of small waves.");
}

WaterLayer::WaterLayer(const Heightfield& bed, const Grid<float>& depth, float least_depth)
    : level_{Grid<float>(depth.width(), depth.height(), nowhere), bed.origin, bed.cell} {
  Grid<float>& level = level_.height;
  for (int j = 0; j < depth.height(); ++j)
    for (int i = 0; i < depth.width(); ++i)
      if (depth(i, j) > least_depth) level(i, j) = bed.height(i, j) + depth(i, j);
  for (int k = 0; k < shore_samples; ++k) level = spread(level, bed);
  const float step = dry_step * static_cast<float>(bed.cell);
  for (int j = 0; j < depth.height(); ++j)
    for (int i = 0; i < depth.width(); ++i)
      if (level(i, j) <= nowhere) level(i, j) = bed.height(i, j) - step;
}

std::optional<float> WaterLayer::level_at(DVec2 place) const {
  if (!contains(place)) return std::nullopt;
  return height_at(level_, place);
}

}  // namespace wold
