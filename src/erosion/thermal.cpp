#include "erosion/thermal.hpp"

#include <algorithm>

#include "base/parallel.hpp"
#include "erosion/ground.hpp"
#include "erosion/thermal_rest.hpp"
#include "erosion/thermal_units.hpp"

namespace wold {

namespace {

bool is_sand(const Thermal& parameters) {
  return parameters.cliff_angle <= parameters.talus_angle;
}

Grid<float> hardness_of(const Heightfield& input, const Thermal& parameters,
                        const TerrainContext& context) {
  if (parameters.hardness.empty()) return {};
  Grid<float> hardness = factor_map(input, parameters.hardness, 0, context);
  if (parameters.hardness_invert)
    for (float& h : hardness.values()) h = 1 - h;
  return hardness;
}

SlideGround ground_of(const Heightfield& input, const Thermal& parameters,
                      const TerrainContext& context) {
  const auto depth = static_cast<double>(parameters.loose_depth);
  const SlideUnits units = slide_units(input, depth, 0);
  SlideGround ground{in_units(input.height, units), {}, {}, units.unit, input.cell};
  ground.hardness = hardness_of(input, parameters, context);
  if (is_sand(parameters)) return ground;
  ground.bed = ground.surface;
  const auto loose = static_cast<std::int32_t>(depth / units.unit);
  for (std::int32_t& bed : ground.bed.values()) bed -= loose;
  return ground;
}

Balance balance_of(const Heightfield& before, const Heightfield& after, const Grid<float>& sunk) {
  Balance ground{"ground"};
  ground.before = volume(before.height, before.cell);
  ground.after = volume(after.height, after.cell);
  ground.moved = volume(sunk, before.cell);
  return ground;
}

}  // namespace

Description<Thermal> describe(const Thermal&) {
  return Description<Thermal>("thermal",
                              "Brings down what is too steep: cliffs break, scree slides until it "
                              "lies at its angle.")
      .add("talus_angle", &Thermal::talus_angle, {.unit = "degrees", .min = 1, .max = 89},
           "Steepest slope on which loose material lies.")
      .add("cliff_angle", &Thermal::cliff_angle, {.unit = "degrees", .min = 0, .max = 90},
           "Steepest slope at which rock stands; 90: rock never breaks; talus_angle or less: all "
           "ground is loose.")
      .add("loose_depth", &Thermal::loose_depth, {.unit = "m", .min = 0, .max = 1000},
           "Depth of the loose material that lies on the rock at first.")
      .add("hardness", &Thermal::hardness,
           "Map that makes rock stand steeper, from 0 (cliff_angle; where all is loose, "
           "talus_angle) to 1 (any slope).")
      .add("hardness_invert", &Thermal::hardness_invert, "White in that map is soft.")
      .choice("neighbours", &Thermal::neighbours, {"four", "diagonals", "alternating"},
              "Between which cells material slides; slopes are measured over all directions.")
      .add("tolerance", &Thermal::tolerance, {.unit = "degrees", .min = 0.01, .max = 10},
           "How far from their angle slopes may come to rest: less is more exact and slower.")
      .add("years", &Thermal::years, {.unit = "years", .min = 0, .max = 1e9},
           "How long material slides; 0: until all rests.")
      .add("rate", &Thermal::rate, {.unit = "m²/year", .min = 1e-6, .max = 1e6},
           "Diffusivity of what is too steep; matters only with years.")
      .add("ladder", &Thermal::ladder,
           "Lets far falls slide over coarser ground first: much faster, without years.")
      .add("max_passes", &Thermal::max_passes, {.min = 1, .max = 1e9},
           "Most passes over the ground, with twice as many over each coarser one; what is still "
           "on its way then runs down and lies down at once. Without years.");
}

TerrainResult thermal(const Heightfield& input, const Thermal& parameters,
                      const TerrainContext& context) {
  check_erosion(input, parameters);
  SlideGround ground = ground_of(input, parameters, context);
  const Grid<std::int32_t> surface = ground.surface;
  const Grid<std::int32_t> bed = ground.bed;
  const SlideRules rules{static_cast<double>(parameters.talus_angle),
                         static_cast<double>(parameters.cliff_angle),
                         static_cast<double>(parameters.tolerance), parameters.neighbours};
  const double spread =
      static_cast<double>(parameters.rate) * static_cast<double>(parameters.years);
  context.progress.begin("thermal", 0, "passes");
  slide(ground, rules, {spread, spread > 0 ? 0 : parameters.max_passes}, parameters.ladder,
        context.progress);
  if (!(spread > 0)) bring_to_rest(ground, rules, context.progress);
  context.progress.end();

  const bool sand = is_sand(parameters);
  TerrainResult result{{changed_heights(input.height, surface, ground.surface, ground.unit),
                        input.origin, input.cell},
                       {}};
  const Grid<float> sunk = positive_difference(surface, ground.surface, ground.unit);
  result.maps["wear"] = sand ? sunk : positive_difference(bed, ground.bed, ground.unit);
  result.maps["sediment"] =
      positive_difference(ground.surface, sand ? surface : ground.bed, ground.unit);
  result.balances.push_back(balance_of(input, result.field, sunk));
  return result;
}

}  // namespace wold
