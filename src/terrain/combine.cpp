#include "terrain/combine.hpp"

#include "terrain/field_map.hpp"
#include "terrain/soft.hpp"

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
  const Grid<float>& other = context.step(parameters.with).field.height;
  return map_heights(input, context, [&](float h, int i, int j) {
    return combined(parameters, h, parameters.scale * other(i, j));
  });
}

}  // namespace wold
