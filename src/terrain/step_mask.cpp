#include "terrain/step_mask.hpp"

#include <algorithm>

#include "terrain/analysis.hpp"
#include "terrain/field_map.hpp"
#include "terrain/import.hpp"
#include "terrain/resample.hpp"
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

/// The map, or null when `name` must be a picture.
const Grid<float>* find_map(const std::string& name, const TerrainContext& context) {
  const auto step = context.named.find(name);
  if (step != context.named.end()) return &mask_of(step->second);
  if (context.maps == nullptr) return nullptr;
  const auto map = context.maps->find(name);
  return map != context.maps->end() ? &map->second : nullptr;
}

}  // namespace

float soft_range(const Range& range, const Range& whole, float width, float x) {
  const float above = range.low > whole.low ? soft_step(range.low, width, x) : 1.0F;
  const float below = range.high < whole.high ? soft_step(-range.high, width, -x) : 1.0F;
  return above * below;
}

Grid<float> map_over(const Heightfield& input, const std::string& name,
                     const TerrainContext& context) {
  const Grid<float>* map = find_map(name, context);
  if (map == nullptr)
    return picture_over(context.folder / name, {}, context.domain, input, context.progress);
  if (map->same_shape(input.height)) return *map;
  return resample(*map, {input.origin, input.size()}, Outside::clamp, input, context.progress);
}

bool has_mask(const StepSettings& settings) {
  const StepSettings everywhere;
  return !settings.mask.empty() || settings.opacity < 1 ||
         settings.mask_height != everywhere.mask_height ||
         settings.mask_slope != everywhere.mask_slope;
}

Grid<float> step_mask(const Heightfield& input, const StepSettings& settings,
                      const TerrainContext& context) {
  Grid<float> named;
  if (!settings.mask.empty()) named = map_over(input, settings.mask, context);
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
