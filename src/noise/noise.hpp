#pragma once
// Lattice noise on the whole plane and space: value and gradient ("Perlin") noise with analytic
// derivatives.
//
// The lattice has a random value, or a random unit gradient, at each point with integer
// coordinates: a hash of the signed coordinates and a seed (lattice.hpp), so there is no mirror and
// no visible period. Between them, with the quintic fade f(t) = 6t⁵ - 15t⁴ + 10t³ (Perlin,
// "Improving noise", SIGGRAPH 2002), value noise interpolates the corner values and gradient noise
// the dot products of corner gradients with the offsets from the corners. Both are scaled to fill
// [-1, 1], never leave it, and are twice continuously differentiable.
//
// Positions are in lattice units (one feature per unit), in double so that places 100 km from the
// origin keep their detail.

#include <cstdint>

#include "base/vec.hpp"

namespace wold {

enum class NoiseBasis { gradient, value };

/// A value and its derivative with respect to position, in lattice units.
struct Sample2 {
  float value = 0;
  Vec2 derivative{0};
};
struct Sample3 {
  float value = 0;
  Vec3 derivative{0};
};

Sample2 value_noise(DVec2 p, std::uint32_t seed);
Sample2 gradient_noise(DVec2 p, std::uint32_t seed);
Sample3 value_noise(DVec3 p, std::uint32_t seed);
Sample3 gradient_noise(DVec3 p, std::uint32_t seed);

}  // namespace wold
