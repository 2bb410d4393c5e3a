#pragma once
// The inside of a lattice cell: fades, corners, and noise with derivatives as inline functions of a
// position and a lattice key. noise.hpp wraps them for single calls; the fractals call them in
// their loops.
//
// With weights U = (1 - u, u), u = f(x), and the same for the other axes, noise is
// n = Σ U_i V_j L_ij, where L is the corner's value, or its gradient dotted with the offset from
// the corner. Derivatives follow by the product rule.

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "base/vec.hpp"
#include "noise/lattice.hpp"
#include "noise/noise.hpp"

namespace wold::noise_cell {

/// A coordinate split into lattice cell (modulo 2^32) and place in the cell, [0, 1].
struct Split {
  std::uint32_t cell;
  float fraction;
};

inline Split split(double x) {
  const double below = std::floor(x);
  return {static_cast<std::uint32_t>(static_cast<std::int64_t>(below)),
          static_cast<float>(x - below)};
}

inline float fade(float t) {
  return t * t * t * (t * (t * 6.0F - 15.0F) + 10.0F);
}
inline float fade_slope(float t) {
  const float a = t * (1.0F - t);
  return 30.0F * a * a;
}
inline float fade_curvature(float t) {
  return 60.0F * t * (t * (2.0F * t - 3.0F) + 1.0F);
}
inline float lerp(float a, float b, float t) {
  return a + t * (b - a);
}

inline Sample2 value_noise(DVec2 p, std::uint32_t key) {
  const Split x = split(p.x);
  const Split y = split(p.y);
  const std::uint32_t row0 = lattice_line(y.cell, key);
  const std::uint32_t row1 = lattice_line(y.cell + 1, key);
  const float a00 = lattice_value(lattice_hash(x.cell, row0));
  const float a10 = lattice_value(lattice_hash(x.cell + 1, row0));
  const float a01 = lattice_value(lattice_hash(x.cell, row1));
  const float a11 = lattice_value(lattice_hash(x.cell + 1, row1));
  const float u = fade(x.fraction);
  const float v = fade(y.fraction);
  const float left = lerp(a00, a01, v);
  const float right = lerp(a10, a11, v);
  return {lerp(left, right, u),
          {fade_slope(x.fraction) * (right - left),
           fade_slope(y.fraction) * lerp(a01 - a00, a11 - a10, u)}};
}

inline Sample2 gradient_noise(DVec2 p, std::uint32_t key) {
  const Split x = split(p.x);
  const Split y = split(p.y);
  const std::uint32_t row0 = lattice_line(y.cell, key);
  const std::uint32_t row1 = lattice_line(y.cell + 1, key);
  const Vec2 g00 = lattice_gradient2(lattice_hash(x.cell, row0));
  const Vec2 g10 = lattice_gradient2(lattice_hash(x.cell + 1, row0));
  const Vec2 g01 = lattice_gradient2(lattice_hash(x.cell, row1));
  const Vec2 g11 = lattice_gradient2(lattice_hash(x.cell + 1, row1));
  const float fx = x.fraction;
  const float fy = y.fraction;
  const float d00 = g00.x * fx + g00.y * fy;
  const float d10 = g10.x * (fx - 1.0F) + g10.y * fy;
  const float d01 = g01.x * fx + g01.y * (fy - 1.0F);
  const float d11 = g11.x * (fx - 1.0F) + g11.y * (fy - 1.0F);
  const float u = fade(fx);
  const float v = fade(fy);
  const float left = lerp(d00, d01, v);
  const float right = lerp(d10, d11, v);
  const float slope_x = lerp(lerp(g00.x, g01.x, v), lerp(g10.x, g11.x, v), u);
  const float slope_y = lerp(lerp(g00.y, g01.y, v), lerp(g10.y, g11.y, v), u);
  return {lerp(left, right, u),
          {slope_x + fade_slope(fx) * (right - left),
           slope_y + fade_slope(fy) * lerp(d01 - d00, d11 - d10, u)}};
}

/// The eight corners as (value, gradient) in the order of bits x, y, z.
template <class Corner>
inline void visit_corners(const Split& x, const Split& y, const Split& z, std::uint32_t key,
                          const Corner& corner) {
  for (std::uint32_t k = 0; k < 2; ++k) {
    const std::uint32_t plane = lattice_line(z.cell + k, key);
    for (std::uint32_t j = 0; j < 2; ++j) {
      const std::uint32_t row = lattice_line(y.cell + j, plane);
      for (std::uint32_t i = 0; i < 2; ++i) corner(i, j, k, lattice_hash(x.cell + i, row));
    }
  }
}

inline Sample3 value_noise(DVec3 p, std::uint32_t key) {
  const Split x = split(p.x);
  const Split y = split(p.y);
  const Split z = split(p.z);
  std::array<float, 8> a;
  visit_corners(x, y, z, key,
                [&](std::uint32_t i, std::uint32_t j, std::uint32_t k, std::uint32_t hash) {
                  a[i + 2 * j + 4 * k] = lattice_value(hash);
                });
  const float u = fade(x.fraction);
  const float v = fade(y.fraction);
  const float w = fade(z.fraction);
  const float x00 = lerp(a[0], a[1], u);
  const float x10 = lerp(a[2], a[3], u);
  const float x01 = lerp(a[4], a[5], u);
  const float x11 = lerp(a[6], a[7], u);
  const float front = lerp(x00, x10, v);
  const float back = lerp(x01, x11, v);
  const float along_x =
      lerp(lerp(a[1] - a[0], a[3] - a[2], v), lerp(a[5] - a[4], a[7] - a[6], v), w);
  return {lerp(front, back, w),
          {fade_slope(x.fraction) * along_x, fade_slope(y.fraction) * lerp(x10 - x00, x11 - x01, w),
           fade_slope(z.fraction) * (back - front)}};
}

inline Sample3 gradient_noise(DVec3 p, std::uint32_t key) {
  const Split x = split(p.x);
  const Split y = split(p.y);
  const Split z = split(p.z);
  std::array<float, 8> d;
  std::array<detail::Gradient3, 8> g;
  visit_corners(x, y, z, key,
                [&](std::uint32_t i, std::uint32_t j, std::uint32_t k, std::uint32_t hash) {
                  const std::size_t c = i + 2 * j + 4 * k;
                  g[c] = detail::gradients3[hash >> 27U];
                  d[c] = g[c].x * (x.fraction - static_cast<float>(i)) +
                         g[c].y * (y.fraction - static_cast<float>(j)) +
                         g[c].z * (z.fraction - static_cast<float>(k));
                });
  const float u = fade(x.fraction);
  const float v = fade(y.fraction);
  const float w = fade(z.fraction);
  const auto blend = [&](auto part) {
    return lerp(lerp(lerp(part(0), part(1), u), lerp(part(2), part(3), u), v),
                lerp(lerp(part(4), part(5), u), lerp(part(6), part(7), u), v), w);
  };
  const float x00 = lerp(d[0], d[1], u);
  const float x10 = lerp(d[2], d[3], u);
  const float x01 = lerp(d[4], d[5], u);
  const float x11 = lerp(d[6], d[7], u);
  const float front = lerp(x00, x10, v);
  const float back = lerp(x01, x11, v);
  const float along_x =
      lerp(lerp(d[1] - d[0], d[3] - d[2], v), lerp(d[5] - d[4], d[7] - d[6], v), w);
  return {lerp(front, back, w),
          {blend([&](std::size_t c) { return g[c].x; }) + fade_slope(x.fraction) * along_x,
           blend([&](std::size_t c) { return g[c].y; }) +
               fade_slope(y.fraction) * lerp(x10 - x00, x11 - x01, w),
           blend([&](std::size_t c) { return g[c].z; }) + fade_slope(z.fraction) * (back - front)}};
}

/// Noise of either basis, chosen at compile time.
template <NoiseBasis basis, class Position>
inline auto noise(Position p, std::uint32_t key) {
  if constexpr (basis == NoiseBasis::gradient)
    return gradient_noise(p, key);
  else
    return value_noise(p, key);
}

}  // namespace wold::noise_cell
