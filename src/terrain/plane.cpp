#include "terrain/plane.hpp"

#include <cmath>

#include "terrain/field_map.hpp"

namespace wold {

Description<Constant> describe(const Constant&) {
  return Description<Constant>("constant", "Level ground.")
      .add("height", &Constant::height, {.unit = "m", .min = -20000, .max = 20000},
           "Height of the ground.");
}

Heightfield constant(const Heightfield& input, const Constant& parameters,
                     const TerrainContext& context) {
  return map_heights(input, context, [&](float, int, int) { return parameters.height; });
}

Description<Plane> describe(const Plane&) {
  return Description<Plane>("plane", "Tilted ground.")
      .add("height", &Plane::height, {.unit = "m", .min = -20000, .max = 20000},
           "Height in the middle of the terrain.")
      .add("slope", &Plane::slope, {.unit = "degrees", .min = 0, .max = 89}, "Steepness.")
      .add("downhill", &Plane::downhill, {.unit = "degrees", .min = -360, .max = 360},
           "Where it falls to, clockwise from north.");
}

Heightfield plane(const Heightfield& input, const Plane& parameters,
                  const TerrainContext& context) {
  const double azimuth = radians(static_cast<double>(parameters.downhill));
  const DVec2 downhill(std::sin(azimuth), std::cos(azimuth));
  const DVec2 fall = std::tan(radians(static_cast<double>(parameters.slope))) * downhill;
  const DVec2 middle = context.domain.center();
  return map_heights(input, context, [&](float, int i, int j) {
    const double drop = glm::dot(fall, place_of(input, i, j) - middle);
    return static_cast<float>(static_cast<double>(parameters.height) - drop);
  });
}

}  // namespace wold
