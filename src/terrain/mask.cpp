#include "terrain/mask.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "terrain/analysis.hpp"
#include "terrain/blur.hpp"
#include "terrain/field_map.hpp"
#include "terrain/fractal_ground.hpp"
#include "terrain/import.hpp"
#include "terrain/soft.hpp"
#include "terrain/step_mask.hpp"

namespace wold {

namespace {

constexpr Fractal patch_fractal{.octaves = patch_octaves};

Grid<float> height_mask(const Heightfield& input, const Mask& m, Progress& progress) {
  return map_grid<float>(input, progress, [&](int i, int j) {
    return soft_range(m.height, {-1e5F, 1e5F}, m.height_feather, input.height(i, j));
  });
}

Grid<float> slope_mask(const Heightfield& input, const Mask& m, Progress& progress) {
  return map_grid<float>(input, progress, [&](int i, int j) {
    return soft_range(m.slope, {0, 90}, m.slope_feather, slope_at_sample(input, i, j));
  });
}

/// A sphere of radius R has the Laplacian -2/R at its top.
Grid<float> curvature_mask(const Heightfield& input, const Mask& m) {
  Grid<float> out = curvature_map(input);
  const float sign = m.from == MaskSource::crests ? -1.0F : 1.0F;
  const float scale = sign * m.curvature_radius / 2;
  for (float& c : out.values()) c = smoothstep(scale * c);
  return out;
}

}  // namespace

float patch_threshold(float coverage) {
  constexpr int count = 61;
  const FractalSampler sample(patch_fractal, 1);
  std::vector<float> values;
  for (int j = 0; j < count; ++j)
    for (int i = 0; i < count; ++i)
      values.push_back(sample(DVec2(0.73 * i + 0.19, 0.73 * j + 0.41)).value);
  std::sort(values.begin(), values.end());
  const auto last = static_cast<float>(values.size() - 1);
  return values[static_cast<std::size_t>((1 - coverage) * last)];
}

namespace {

Grid<float> noise_mask(const Heightfield& input, const Mask& m, const TerrainContext& context) {
  Grid<float> out =
      irregular(input, m.feature_size, patch_fractal.octaves, context.seed, context.progress);
  const float threshold = patch_threshold(m.coverage);
  for (float& n : out.values()) n = soft_step(threshold, m.edge, n);
  return out;
}

Grid<float> mask_of_map(const Heightfield& input, const Mask& m, const TerrainContext& context) {
  if (m.map.empty()) throw Error(ErrorKind::input, "a mask from a map needs a 'map'");
  if (m.map_range.high <= m.map_range.low || (m.logarithmic && m.map_range.low <= 0))
    throw Error(
        ErrorKind::input,
        "the two values in 'map_range' of 'mask' must differ, and be above 0 if logarithmic");
  const auto scaled = [&](float value) {
    return m.logarithmic ? std::log(std::max(value, m.map_range.low)) : value;
  };
  const float low = scaled(m.map_range.low);
  const float per_unit = 1 / (scaled(m.map_range.high) - low);
  Grid<float> map = map_over(input, m.map, context);
  for (float& value : map.values())
    value = std::clamp((scaled(value) - low) * per_unit, 0.0F, 1.0F);
  return map;
}

Grid<float> source_map(const Heightfield& input, const Mask& m, const TerrainContext& context) {
  switch (m.from) {
    case MaskSource::height: return height_mask(input, m, context.progress);
    case MaskSource::slope: return slope_mask(input, m, context.progress);
    case MaskSource::crests:
    case MaskSource::hollows: return curvature_mask(input, m);
    case MaskSource::noise: return noise_mask(input, m, context);
    case MaskSource::map: return mask_of_map(input, m, context);
    case MaskSource::picture: break;
  }
  if (m.picture.empty()) throw Error(ErrorKind::input, "a mask from a picture needs a 'picture'");
  return picture_over(context.folder / m.picture.path, m.channel, context.domain, input,
                      context.progress);
}

}  // namespace

Description<Mask> describe(const Mask&) {
  using M = Mask;
  return Description<M>("mask", "Makes a map of where later steps act; the ground stays as it is.")
      .choice("from", &M::from, {"height", "slope", "crests", "hollows", "noise", "picture", "map"},
              "What the map shows.")
      .add("height", &M::height, {.unit = "m", .min = -1e5, .max = 1e5}, "Heights that are inside.")
      .add("height_feather", &M::height_feather, {.unit = "m", .min = 0, .max = 1e5},
           "Width of the soft edge of heights.")
      .add("slope", &M::slope, {.unit = "degrees", .min = 0, .max = 90}, "Slopes that are inside.")
      .add("slope_feather", &M::slope_feather, {.unit = "degrees", .min = 0, .max = 90},
           "Width of the soft edge of slopes.")
      .add("curvature_radius", &M::curvature_radius, {.unit = "m", .min = 0.1, .max = 1e6},
           "Crests and hollows as sharp as a sphere of this radius are wholly inside.")
      .add("feature_size", &M::feature_size, {.unit = "m", .min = 0.1, .max = 1e6},
           "Size of the patches of noise.")
      .add("coverage", &M::coverage, {.min = 0, .max = 1}, "Part that the patches cover.")
      .add("edge", &M::edge, {.min = 0, .max = 2}, "Softness of the edge of patches.")
      .add("picture", &M::picture, "A picture laid over the whole terrain, north up.")
      .add("channel", &M::channel, "The picture's channel; default: the first.")
      .add("map", &M::map, "A map of a step before, such as rivers.flow.")
      .add("map_range", &M::map_range, {.min = -1e9, .max = 1e12},
           "Values of the map that become 0 and 1.")
      .add("logarithmic", &M::logarithmic,
           "Measures the map's values by their magnitude, as areas want it.")
      .add("times", &M::times, "Another map that this one is multiplied by: inside both.")
      .add("smooth", &M::smooth, {.unit = "m", .min = 0, .max = 1e5},
           "Smooths the ground before slope and curvature are taken.")
      .add("invert", &M::invert, "Turns inside and outside over.");
}

TerrainResult make_mask(const Heightfield& input, const Mask& parameters,
                        const TerrainContext& context) {
  Heightfield smooth = input;
  if (parameters.smooth > 0)
    smooth.height = blurred(input.height, static_cast<double>(parameters.smooth) / input.cell,
                            context.progress);
  Grid<float> map = source_map(smooth, parameters, context);
  if (parameters.invert)
    for (float& value : map.values()) value = 1 - value;
  if (!parameters.times.empty()) {
    const Grid<float> other = map_over(input, parameters.times, context);
    for (std::size_t k = 0; k < map.size(); ++k)
      map.values()[k] *= std::clamp(other.values()[k], 0.0F, 1.0F);
  }
  TerrainResult result{input, {}};
  result.maps["mask"] = std::move(map);
  return result;
}

double reach_of(const Mask& parameters, double cell) {
  const double smooth =
      parameters.smooth > 0 ? reach_of(Blur{.distance = parameters.smooth}, cell) : 0;
  return smooth + 2 * cell;
}

}  // namespace wold
