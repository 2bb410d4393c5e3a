#include "terrain/combine.hpp"

#include "terrain/field_map.hpp"
#include "terrain/resample.hpp"
#include "terrain/soft.hpp"
#include "terrain/step_mask.hpp"

namespace wold {

namespace {

float combined(const Combine& c, float a, float b) {
  switch (c.method) {
    case CombineMethod::add: return a + b;
    case CombineMethod::subtract: return a - b;
    case CombineMethod::multiply: return a * b;
    case CombineMethod::max: return std::max(a, b);
    case CombineMethod::min: return std::min(a, b);
    case CombineMethod::smooth_max: return soft_max(a, b, c.softness);
    case CombineMethod::smooth_min: return soft_min(a, b, c.softness);
    case CombineMethod::mix: break;
  }
  return a + c.amount * (b - a);
}

}  // namespace

Description<Combine> describe(const Combine&) {
  using C = Combine;
  return Description<C>("combine", "Joins the ground with that of a named step.")
      .add("with", &C::with, "The name of the other step.")
      .choice("method", &C::method,
              {"add", "subtract", "multiply", "max", "min", "smooth_max", "smooth_min", "mix"},
              "How the two meet.")
      .add("scale", &C::scale, {.min = -1000, .max = 1000}, "What the other is multiplied by.")
      .add("softness", &C::softness, {.unit = "m", .min = 0, .max = 1e5},
           "Rounds off smooth_max and smooth_min over so much height.")
      .add("amount", &C::amount, {.min = 0, .max = 1}, "Share of the other in mix.");
}

Heightfield combine(const Heightfield& input, const Combine& parameters,
                    const TerrainContext& context) {
  Grid<float> other = context.step(parameters.with).field.height;
  if (!other.same_shape(input.height))
    other = resample(other, {input.origin, input.size()}, Outside::clamp, input, context.progress);
  return map_heights(input, context, [&](float h, int i, int j) {
    return combined(parameters, h, parameters.scale * other(i, j));
  });
}

Description<AddMap> describe(const AddMap&) {
  return Description<AddMap>("add_map", "Raises the ground by a map, such as the depth of water.")
      .add("map", &AddMap::map, "A map of a step before, such as rivers.water, or a picture.")
      .add("factor", &AddMap::factor, {.unit = "m", .min = -1e5, .max = 1e5},
           "Height of a value of 1.");
}

Heightfield add_map(const Heightfield& input, const AddMap& parameters,
                    const TerrainContext& context) {
  if (parameters.map.empty()) throw Error(ErrorKind::input, "'add_map' needs a 'map'");
  const Grid<float> map = map_over(input, parameters.map, context);
  return map_heights(input, context,
                     [&](float h, int i, int j) { return h + parameters.factor * map(i, j); });
}

}  // namespace wold
