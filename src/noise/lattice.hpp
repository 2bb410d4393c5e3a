#pragma once
// The integer lattice beneath all noise: a 32-bit hash of signed coordinates and a seed, and the
// random value or gradient that a hash stands for. Only 32-bit multiplies, shifts and xors, so that
// the same bits come from C++, from SIMD lanes and from GLSL `uint`.
//
//   key   = lattice_key(seed)             once per octave
//   plane = lattice_line(z, key)          once per plane (3D; in 2D plane = key)
//   row   = lattice_line(y, plane)        once per row
//   hash  = lattice_hash(x, row)          once per lattice point
//
// Coordinates enter modulo 2^32, in two's complement: there is no mirror at zero, and the period of
// 2^32 features cannot be seen. The finaliser is `lowbias32` (Wellons, "Prospecting for hash
// functions", 2018) with the constants of its later search (multipliers 0x21f0aaad, 0xd35a2d97);
// nesting the axes rather than xor-ing three products follows Jarzynski and Olano, "Hash functions
// for GPU rendering", JCGT 9(3), 2020.
//
// Gradients. In 2D 16 directions evenly spread, 11.25° + k · 22.5°: four in the first quadrant,
// and a sign for each axis. In 3D 32 directions: (1, 1, 1)/√3 and the permutations of (q, p, p),
// and a sign for each axis, where q² = (1 + √(1 + 6 (31/45 - 1/2))) / 3 makes the mean of each
// axis' fourth power 1/5, as for directions spread over the whole sphere: no axis stands out up to
// the fifth moment.
//
// Bits of a hash: 31, 30 (and 29 in 3D) are the signs of x, y (and z), set for negative; the next
// two choose among the four directions. As a value, the hash is a signed fraction in [-1, 1].

#include <array>
#include <cstdint>

#include "base/vec.hpp"

namespace wold {

inline constexpr std::uint32_t lattice_x_factor = 0x9e3779b1U;
inline constexpr std::uint32_t lattice_line_factor = 0x85ebca77U;
inline constexpr std::uint32_t lattice_line_mixer = 0xc2b2ae3dU;

/// Mixes all 32 bits; a bijection (`lowbias32`).
constexpr std::uint32_t mix_bits32(std::uint32_t h) {
  h ^= h >> 16U;
  h *= 0x21f0aaadU;
  h ^= h >> 15U;
  h *= 0xd35a2d97U;
  h ^= h >> 15U;
  return h;
}

constexpr std::uint32_t lattice_key(std::uint32_t seed) {
  return mix_bits32(seed + 0x9e3779b9U);
}

/// The key of one line (or plane) of the lattice from the key of what it lies in.
constexpr std::uint32_t lattice_line(std::uint32_t coordinate, std::uint32_t key) {
  std::uint32_t h = coordinate * lattice_line_factor ^ key;
  h ^= h >> 15U;
  h *= lattice_line_mixer;
  h ^= h >> 16U;
  return h;
}

constexpr std::uint32_t lattice_hash(std::uint32_t x, std::uint32_t row) {
  return mix_bits32(x * lattice_x_factor ^ row);
}

/// Scales that make the noises fill [-1, 1]: one over the greatest sum, over the cell, of corner
/// weight times the best gradient's dot product with the offset (found by search in 2D, at
/// (1/2, 0.473378); in 3D √3/2 at the centre), less a part in a million for rounding.
inline constexpr double lattice_margin = 1 - 1e-6;
inline constexpr double gradient2_scale = 1.438119093677062 * lattice_margin;
inline constexpr double gradient3_scale = 1.1547005383792515 * lattice_margin;

namespace detail {

// The directions of the first quadrant or octant, unit length.
inline constexpr std::array<double, 4> quadrant_x{0.98078528040323044, 0.83146961230254524,
                                                  0.55557023301960222, 0.19509032201612827};
inline constexpr double octant_s = 0.57735026918962576;  // 1/√3
inline constexpr double octant_q = 0.90564773995935133;
inline constexpr double octant_p = 0.29983509726724711;
inline constexpr std::array<double, 4> octant_x{octant_s, octant_q, octant_p, octant_p};
inline constexpr std::array<double, 4> octant_y{octant_s, octant_p, octant_q, octant_p};
inline constexpr std::array<double, 4> octant_z{octant_s, octant_p, octant_p, octant_q};

struct Gradient2 {
  float x, y;
};
struct Gradient3 {
  float x, y, z, unused;
};

constexpr std::array<Gradient2, 16> make_gradients2() {
  std::array<Gradient2, 16> table{};
  for (unsigned h = 0; h < 16; ++h) {
    const double x = quadrant_x[h & 3U] * gradient2_scale;
    const double y = quadrant_x[3U - (h & 3U)] * gradient2_scale;
    table[h] = {static_cast<float>((h & 8U) != 0 ? -x : x),
                static_cast<float>((h & 4U) != 0 ? -y : y)};
  }
  return table;
}

constexpr std::array<Gradient3, 32> make_gradients3() {
  std::array<Gradient3, 32> table{};
  for (unsigned h = 0; h < 32; ++h) {
    const double x = octant_x[h & 3U] * gradient3_scale;
    const double y = octant_y[h & 3U] * gradient3_scale;
    const double z = octant_z[h & 3U] * gradient3_scale;
    table[h] = {static_cast<float>((h & 16U) != 0 ? -x : x),
                static_cast<float>((h & 8U) != 0 ? -y : y),
                static_cast<float>((h & 4U) != 0 ? -z : z), 0};
  }
  return table;
}

inline constexpr std::array<Gradient2, 16> gradients2 = make_gradients2();
inline constexpr std::array<Gradient3, 32> gradients3 = make_gradients3();

}  // namespace detail

/// The random gradient of a lattice point, scaled so that the noise fills [-1, 1].
inline Vec2 lattice_gradient2(std::uint32_t hash) {
  const detail::Gradient2& g = detail::gradients2[hash >> 28U];
  return {g.x, g.y};
}
inline Vec3 lattice_gradient3(std::uint32_t hash) {
  const detail::Gradient3& g = detail::gradients3[hash >> 27U];
  return {g.x, g.y, g.z};
}

/// The random value of a lattice point, in [-1, 1].
inline constexpr float lattice_value_scale = static_cast<float>(lattice_margin * 0x1p-31);
inline float lattice_value(std::uint32_t hash) {
  return static_cast<float>(static_cast<std::int32_t>(hash)) * lattice_value_scale;
}

}  // namespace wold
