#pragma once
// Fractals: sums of noise over octaves. With f_i = lacunarity^i and a_i = f_i^-H (Ebert et al., Texturing and
// Modeling, 3rd ed., chapter 16); the formula of each kind stands at its enumerator.
//
// Octaves finer than the sample spacing are faded out: octave i has weight 1 while its feature spans four
// spacings or more and 0 from two (the Nyquist limit) down.

#include <cstdint>

#include "base/grid.hpp"
#include "base/progress.hpp"
#include "noise/noise.hpp"

namespace wold {

enum class FractalKind {
  fbm,        ///< Σ a_i n(f_i p), about [-1, 1]
  hybrid,     ///< hybrid multifractal: valleys smooth, heights rough
  ridged,     ///< ridged multifractal: sharp crests
  turbulence, ///< Σ a_i |n(f_i p)|, billows
  eroded      ///< fBm whose octaves are damped by the slope gathered so far (Quilez 2008)
};

struct Fractal {
  FractalKind kind = FractalKind::fbm;
  NoiseBasis basis = NoiseBasis::gradient;
  int octaves = 10;
  float lacunarity = 2;
  float hurst = 1;          ///< H; amplitude falls as frequency^-H
  float offset = 1;         ///< hybrid (near 0.7) and ridged (1)
  float gain = 2;           ///< ridged
  float smooth_ridges = 0;  ///< ridged, k: |x| becomes sqrt(x² + k²)
  float damping = 1;        ///< eroded: how much slope damps finer octaves
};

/// The fractal and its derivative at p (lattice units of the first octave). `spacing` is the distance between
/// samples, in the same units, for the fade of octaves; 0 keeps all.
Sample2 fractal(const Fractal& f, DVec2 p, std::uint32_t seed, float spacing = 0);
Sample3 fractal(const Fractal& f, DVec3 p, std::uint32_t seed, float spacing = 0);

/// Fills a grid: sample (i, j) is the fractal at origin + step · (i, j). Vectorised; agrees with `fractal` to 1e-5 of
/// its range, and is the same for any number of threads. Octaves fade by `step`.
void fill_fractal(GridView<float> out, const Fractal& f, DVec2 origin, double step, std::uint32_t seed, Progress& progress);

/// One octave of noise over a grid, vectorised, as fill_fractal.
void fill_noise(GridView<float> out, NoiseBasis basis, DVec2 origin, double step, std::uint32_t seed, Progress& progress);

} // namespace wold
