#include "terrain/step_mask.hpp"

#include <algorithm>

#include "terrain/analysis.hpp"
#include "terrain/field_map.hpp"
#include "terrain/import.hpp"
#include "terrain/soft.hpp"

namespace wold {

namespace {

constexpr Range whole_height{-1e5F, 1e5F};
constexpr Range whole_slope{0, 90};

/// A named step's map: the one that it made to be a mask, or its only one, or its heights.
const Grid<float>& mask_of(const TerrainResult& result) {
  const auto mask = result.maps.find("mask");
  if (mask != result.maps.end()) return mask->second;
  return result.maps.size() == 1 ? result.maps.begin()->second : result.field.height;
}

Grid<float> named_mask(const Heightfield& input, const std::string& name,
                       const std::map<std::string, Grid<float>>& maps,
                       const TerrainContext& context) {
  const auto step = context.named.find(name);
  if (step != context.named.end()) return mask_of(step->second);
  const auto map = maps.find(name);
  if (map != maps.end()) return map->second;
  return picture_over(context.folder / name, {}, context.domain, input, context.progress);
}

}  // namespace

float soft_range(const Range& range, const Range& whole, float width, float x) {
  const float above = range.low > whole.low ? soft_step(range.low, width, x) : 1.0F;
  const float below = range.high < whole.high ? soft_step(-range.high, width, -x) : 1.0F;
  return above * below;
}

bool has_mask(const StepSettings& settings) {
  const StepSettings everywhere;
  return !settings.mask.empty() || settings.opacity < 1 ||
         settings.mask_height != everywhere.mask_height ||
         settings.mask_slope != everywhere.mask_slope;
}

Grid<float> step_mask(const Heightfield& input, const StepSettings& settings,
                      const std::map<std::string, Grid<float>>& maps,
                      const TerrainContext& context) {
  Grid<float> named;
  if (!settings.mask.empty()) named = named_mask(input, settings.mask, maps, context);
  const bool by_slope = settings.mask_slope != whole_slope;
  return map_grid<float>(input, context.progress, [&](int i, int j) {
    float m = settings.opacity;
    if (!named.empty()) {
      const float value = std::clamp(named(i, j), 0.0F, 1.0F);
      m *= settings.mask_invert ? 1 - value : value;
    }
    m *= soft_range(settings.mask_height, whole_height, settings.mask_height_feather,
                    input.height(i, j));
    if (by_slope)
      m *= soft_range(settings.mask_slope, whole_slope, settings.mask_slope_feather,
                      slope_at_sample(input, i, j));
    return m;
  });
}

}  // namespace wold
