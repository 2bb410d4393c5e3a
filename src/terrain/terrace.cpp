#include "terrain/terrace.hpp"

#include <cmath>

#include "terrain/field_map.hpp"
#include "terrain/fractal_ground.hpp"
#include "terrain/soft.hpp"

namespace wold {

Description<Terrace> describe(const Terrace&) {
  using T = Terrace;
  return Description<T>("terrace", "Steps in the ground, as layers of hard rock leave them.")
      .add("spacing", &T::spacing, {.unit = "m", .min = 0.01, .max = 1e4}, "Height of a step.")
      .add("flat", &T::flat, {.min = 0, .max = 0.95}, "Part of each layer that is level.")
      .add("strength", &T::strength, {.min = 0, .max = 1}, "How much the ground follows the steps.")
      .add("variation", &T::variation, {.unit = "m", .min = 0, .max = 1e4},
           "How far the layers bend up and down.")
      .add("feature_size", &T::feature_size, {.unit = "m", .min = 0.1, .max = 1e6},
           "Size of the bends.");
}

Heightfield terrace(const Heightfield& input, const Terrace& parameters,
                    const TerrainContext& context) {
  Grid<float> bend;
  if (parameters.variation > 0)
    bend = irregular(input, parameters.feature_size, 4, context.seed, context.progress);
  return map_heights(input, context, [&](float h, int i, int j) {
    const float shift = bend.empty() ? 0 : parameters.variation * bend(i, j);
    const float x = (h + shift) / parameters.spacing;
    const float layer = std::floor(x);
    const float rise = smoothstep((x - layer - parameters.flat) / (1 - parameters.flat));
    const float stepped = parameters.spacing * (layer + rise) - shift;
    return h + parameters.strength * (stepped - h);
  });
}

}  // namespace wold
