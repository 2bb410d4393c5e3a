#include "erosion/snow.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/parallel.hpp"
#include "base/smoothstep.hpp"
#include "erosion/ground.hpp"
#include "erosion/thermal_rest.hpp"
#include "erosion/thermal_units.hpp"
#include "terrain/analysis.hpp"
#include "terrain/field_map.hpp"

namespace wold {

namespace {

constexpr float most_drift = 2;

/// What falls, m.
Grid<float> snowfall(const Heightfield& input, const Snow& parameters,
                     const TerrainContext& context) {
  const Grid<float> share = factor_map(input, parameters.map, 1, context);
  const float from = radians(parameters.wind_from);
  const Vec2 wind(-std::sin(from), -std::cos(from));
  const float half = parameters.feather / 2;
  return map_grid<float>(input, context.progress, [&](int i, int j) {
    const float above =
        smoothstep(parameters.snow_line - half, parameters.snow_line + half, input.height(i, j));
    const float lee = parameters.drift > 0
                          ? 1 - parameters.drift * glm::dot(gradient_at_sample(input, i, j), wind)
                          : 1.0F;
    return parameters.depth * above * share(i, j) * std::clamp(lee, 0.0F, most_drift);
  });
}

}  // namespace

Description<Snow> describe(const Snow&) {
  return Description<Snow>("snow", "Snow that falls and slides off what is too steep for it.")
      .add("depth", &Snow::depth, {.unit = "m", .min = 0, .max = 100},
           "Depth that falls high above the snow line.")
      .add("snow_line", &Snow::snow_line, {.unit = "m", .min = -12000, .max = 12000},
           "Height of the ground at which half of that falls.")
      .add("feather", &Snow::feather, {.unit = "m", .min = 0, .max = 12000},
           "Difference of height from no snow to all of it.")
      .add("angle", &Snow::angle, {.unit = "degrees", .min = 1, .max = 89},
           "Steepest slope on which snow lies.")
      .add("map", &Snow::map, "Map that the depth is multiplied with, from 0 to 1.")
      .add("wind_from", &Snow::wind_from, {.unit = "degrees", .min = 0, .max = 360},
           "Where the wind comes from, clockwise from north.")
      .add("drift", &Snow::drift, {.min = 0, .max = 10},
           "How much more falls in the lee: at 1 twice as much on a slope of 45 degrees.")
      .add("tolerance", &Snow::tolerance, {.unit = "degrees", .min = 0.01, .max = 10},
           "How far from its angle snow may come to rest: less is more exact and slower.")
      .add("max_passes", &Snow::max_passes, {.min = 1, .max = 1e9},
           "Most passes over the ground; what is still on its way then runs down and lies down at "
           "once.");
}

TerrainResult snow(const Heightfield& input, const Snow& parameters,
                   const TerrainContext& context) {
  check_erosion(input, parameters);
  const SlideUnits units =
      slide_units(input, 0, static_cast<double>(most_drift * parameters.depth));
  SlideGround ground{{}, in_units(input.height, units), {}, units.unit, input.cell};
  ground.surface = in_units(snowfall(input, parameters, context), {0, units.unit});
  const double fallen = [&] {
    double sum = 0;
    for (const std::int32_t depth : ground.surface.values()) sum += depth;
    return sum * units.unit * input.cell * input.cell;
  }();
  parallel_for(0, input.height.height(), [&](int j) {
    std::transform(ground.surface.row(j).begin(), ground.surface.row(j).end(),
                   ground.bed.row(j).begin(), ground.surface.row(j).begin(), std::plus<>{});
  });
  const Grid<std::int32_t> bed = ground.bed;
  const Grid<std::int32_t> before = ground.surface;
  const SlideRules rules{static_cast<double>(parameters.angle), 90,
                         static_cast<double>(parameters.tolerance)};
  context.progress.begin("snow", 0, "passes");
  slide(ground, rules, {0, parameters.max_passes}, false, context.progress);
  bring_to_rest(ground, rules, context.progress);
  context.progress.end();

  TerrainResult result{
      {changed_heights(input.height, bed, ground.surface, units.unit), input.origin, input.cell},
      {}};
  result.maps["snow"] = positive_difference(ground.surface, bed, units.unit);
  Balance balance{"snow"};
  balance.added = fallen;
  balance.after = volume(result.maps["snow"], input.cell);
  balance.moved =
      fallen + volume(positive_difference(before, ground.surface, units.unit), input.cell);
  result.balances.push_back(balance);
  return result;
}

}  // namespace wold
