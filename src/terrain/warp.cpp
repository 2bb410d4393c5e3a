#include "terrain/warp.hpp"

#include <algorithm>

#include "base/hash.hpp"
#include "terrain/field_map.hpp"
#include "terrain/fractal_ground.hpp"

namespace wold {

namespace {

/// Noise seldom comes near its bounds: stretched, then held.
float displacement(float noise) {
  return std::clamp(1.6F * noise, -1.0F, 1.0F);
}

}  // namespace

Description<Warp> describe(const Warp&) {
  return Description<Warp>("warp", "Moves the ground sideways by noise: winding shapes.")
      .add("distance", &Warp::distance, {.unit = "m", .min = 0, .max = 1e5},
           "How far the ground is moved at most.")
      .add("feature_size", &Warp::feature_size, {.unit = "m", .min = 0.1, .max = 1e6},
           "Size of the bends.")
      .add("octaves", &Warp::octaves, {.min = 1, .max = 16}, "Number of frequencies of the bends.");
}

Heightfield warp(const Heightfield& input, const Warp& parameters, const TerrainContext& context) {
  const auto noise = [&](int axis) {
    return irregular(input, parameters.feature_size, parameters.octaves,
                     random_bits(context.seed, axis), context.progress);
  };
  const Grid<float> east = noise(0);
  const Grid<float> north = noise(1);
  const auto distance = static_cast<double>(parameters.distance);
  return map_heights(input, context, [&](float, int i, int j) {
    const DVec2 move(displacement(east(i, j)), displacement(north(i, j)));
    return ground_at(input, place_of(input, i, j) + distance * move).height;
  });
}

double reach_of(const Warp& parameters, double cell) {
  return static_cast<double>(parameters.distance) + 2 * cell;
}

}  // namespace wold
