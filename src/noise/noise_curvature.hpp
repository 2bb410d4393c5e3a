#pragma once
// Noise with first and second derivatives, which the eroded fractal needs for its own derivative.
// Plain sums over the corners of a cell, in any dimension: slower than noise_cell.hpp, which all
// else uses.
//
//   n    = Σ W L                                    W = Π W_a(x_a), L = value or g · (x - corner)
//   n_a  = Σ (W'_a L + W_a G_a) Π_{c≠a} W_c
//   n_aa = Σ (W''_a L + 2 W'_a G_a) Π_{c≠a} W_c
//   n_ab = Σ (W'_a W'_b L + W'_a W_b G_b + W_a W'_b G_a) Π_{c≠a,b} W_c

#include <array>
#include <cstddef>
#include <cstdint>

#include "noise/noise_cell.hpp"

namespace wold::noise_cell {

template <class Vector, class Matrix>
struct Curvature {
  float value = 0;
  Vector slope{0};
  Matrix second{0};
};

/// What one corner adds: its fades in each axis with two derivatives, its value and gradient.
template <std::size_t dimension>
struct CornerTerm {
  std::array<std::array<float, 3>, dimension> fade{};
  std::array<float, dimension> gradient{};
  float value = 0;

  /// The product of the fades, with axis a (and b) differentiated so many times.
  float weight(std::size_t a = dimension, std::size_t order_a = 0, std::size_t b = dimension,
               std::size_t order_b = 0) const {
    float product = 1;
    for (std::size_t c = 0; c < dimension; ++c) {
      std::size_t order = 0;
      if (c == a) order = order_a;
      if (c == b) order = order_b;
      product *= fade[c][order];
    }
    return product;
  }

  template <class Vector, class Matrix>
  void add_to(Curvature<Vector, Matrix>& sum) const {
    sum.value += weight() * value;
    for (std::size_t a = 0; a < dimension; ++a) {
      const auto ia = static_cast<int>(a);
      sum.slope[ia] += weight(a, 1) * value + weight() * gradient[a];
      sum.second[ia][ia] += weight(a, 2) * value + 2.0F * weight(a, 1) * gradient[a];
      for (std::size_t b = a + 1; b < dimension; ++b) {
        const auto ib = static_cast<int>(b);
        const float mixed =
            weight(a, 1, b, 1) * value + weight(a, 1) * gradient[b] + weight(b, 1) * gradient[a];
        sum.second[ia][ib] += mixed;
        sum.second[ib][ia] += mixed;
      }
    }
  }
};

/// `Position` is DVec2 or DVec3, `Vector` and `Matrix` those of its derivatives.
template <NoiseBasis basis, class Vector, class Matrix, class Position>
Curvature<Vector, Matrix> curvature(const Position& p, std::uint32_t key) {
  constexpr auto dimension = static_cast<std::size_t>(Position::length());
  std::array<Split, dimension> x;
  std::array<std::array<float, 3>, dimension> rise;
  for (std::size_t a = 0; a < dimension; ++a) {
    x[a] = split(p[static_cast<int>(a)]);
    const float t = x[a].fraction;
    rise[a] = {fade(t), fade_slope(t), fade_curvature(t)};
  }
  Curvature<Vector, Matrix> sum;
  for (std::uint32_t corner = 0; corner < (1U << dimension); ++corner) {
    CornerTerm<dimension> term;
    std::array<float, dimension> offset{};
    std::uint32_t line = key;
    for (std::size_t a = dimension; a-- > 0;) {
      const std::uint32_t side = corner >> a & 1U;
      const std::uint32_t coordinate = x[a].cell + side;
      line = a == 0 ? lattice_hash(coordinate, line) : lattice_line(coordinate, line);
      offset[a] = x[a].fraction - static_cast<float>(side);
      term.fade[a] =
          side != 0 ? rise[a] : std::array<float, 3>{1.0F - rise[a][0], -rise[a][1], -rise[a][2]};
    }
    if constexpr (basis == NoiseBasis::value) {
      term.value = lattice_value(line);
    } else {
      if constexpr (dimension == 2) {
        const Vec2 g = lattice_gradient2(line);
        term.gradient = {g.x, g.y};
      } else {
        const Vec3 g = lattice_gradient3(line);
        term.gradient = {g.x, g.y, g.z};
      }
      for (std::size_t a = 0; a < dimension; ++a) term.value += term.gradient[a] * offset[a];
    }
    term.add_to(sum);
  }
  return sum;
}

}  // namespace wold::noise_cell
