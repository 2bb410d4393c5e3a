#include "terrain/falloff.hpp"

#include <algorithm>
#include <cmath>

#include "terrain/field_map.hpp"
#include "terrain/fractal_ground.hpp"
#include "terrain/soft.hpp"

namespace wold {

namespace {

/// Distance to the edge, m; negative outside. Round: of the ellipse that fills the domain, about.
double inside_distance(const TerrainDomain& domain, FalloffShape shape, DVec2 place) {
  const DVec2 half = 0.5 * domain.size;
  const DVec2 from_middle = place - domain.center();
  const DVec2 to_side = half - DVec2(std::abs(from_middle.x), std::abs(from_middle.y));
  if (shape == FalloffShape::square) return std::min(to_side.x, to_side.y);
  return (1 - glm::length(from_middle / half)) * std::min(half.x, half.y);
}

}  // namespace

Description<Falloff> describe(const Falloff&) {
  using F = Falloff;
  return Description<F>("falloff", "Lowers the ground towards the edge: islands.")
      .choice("shape", &F::shape, {"round", "square"}, "Shape of what remains.")
      .add("width", &F::width, {.unit = "m", .min = 0.1, .max = 1e6},
           "Width of the band in which the ground goes down.")
      .add("level", &F::level, {.unit = "m", .min = -20000, .max = 20000},
           "Height at the edge and beyond.")
      .add("irregularity", &F::irregularity, {.unit = "m", .min = 0, .max = 1e6},
           "How far noise shifts the band inwards.")
      .add("feature_size", &F::feature_size, {.unit = "m", .min = 0.1, .max = 1e6},
           "Size of the bays.");
}

Heightfield falloff(const Heightfield& input, const Falloff& parameters,
                    const TerrainContext& context) {
  const Grid<float> noise =
      irregular(input, parameters.feature_size, 4, context.seed, context.progress);
  return map_heights(input, context, [&](float h, int i, int j) {
    const double inside = inside_distance(context.domain, parameters.shape, place_of(input, i, j));
    // Inwards only: at the edge itself the ground is at its level.
    const float shift = parameters.irregularity * smoothstep(0.5F + 0.7F * noise(i, j));
    const float depth = (static_cast<float>(inside) - shift) / parameters.width;
    return parameters.level + smoothstep(depth) * (h - parameters.level);
  });
}

}  // namespace wold
