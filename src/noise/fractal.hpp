#pragma once
// Fractals: sums of noise over octaves. With f_i = lacunarity^i and a_i = f_i^-H (Ebert et al.,
// Texturing and Modeling, 3rd ed., chapter 16); the formula of each kind stands at its enumerator.
//
// Octave i looks at p_i, where p_0 = R p + d and p_{i+1} = lacunarity · R p_i + d, with a fixed
// rotation R and shift d (`octave_turn`, `octave_shift`), and has a seed of its own: so the
// lattices of two octaves never coincide, none lies along the axes, and no point of the plane (the
// origin, say) is a zero of all. The text writes n(f_i p) for it.
//
// Octaves finer than the sample spacing are faded out: octave i has weight 1 while its feature
// spans four spacings or more and 0 from two (the Nyquist limit) down, with a smooth step between.
//
// Derivatives are exact: sums and products of the noise's analytic derivatives. Where a formula has
// a crease (|n|, min, clamp), the derivative is that of one side.

#include <array>
#include <cstdint>

#include "base/grid.hpp"
#include "base/progress.hpp"
#include "noise/noise.hpp"

namespace wold {

enum class FractalKind {
  fbm,     ///< Σ a_i n(f_i p), within ±Σ a_i, mostly within [-1, 1]
  hybrid,  ///< r = w = a_0 (n(p) + offset); then w = min(w, 1), w *= a_i (n(f_i p) + offset),
           ///< r += w: valleys smooth, heights rough
  ridged,  ///< s = r = (offset - |n(p)|)²; then s = (offset - |n(f_i p)|)² clamp(gain s, 0, 1),
           ///< r += a_i s: sharp crests; from 0 to Σ a_i with offset 1
  turbulence,  ///< Σ a_i |n(f_i p)|, from 0 to Σ a_i: billows
  eroded  ///< Σ a_i n(f_i p) / (1 + damping |d|²), d the slope of the undamped sum so far, this
          ///< octave included: fine detail on flats only (Quilez, "Value noise derivatives",
          ///< 2008); within ±Σ a_i
};

struct Fractal {
  FractalKind kind = FractalKind::fbm;
  NoiseBasis basis = NoiseBasis::gradient;
  int octaves = 10;         ///< 0 to max_octaves
  float lacunarity = 2;     ///< 1 to 16
  float hurst = 1;          ///< H; amplitude falls as frequency^-H
  float offset = 1;         ///< hybrid (near 0.7) and ridged (1)
  float gain = 2;           ///< ridged
  float smooth_ridges = 0;  ///< ridged, k: |x| becomes sqrt(x² + k²)
  float damping = 1;        ///< eroded: how much slope damps finer octaves

  static constexpr int max_octaves = 32;
};

/// By how much each octave is turned against the one before, in the plane (36.87°) and in space
/// (86.2° about (1, 2, 3)): angles whose multiples don't return to the axes.
inline const DMat2 octave_turn2{0.8, 0.6, -0.6, 0.8};  // by columns
inline const DMat3 octave_turn3 = DMat3{4, 28, -10, -20, 10, 20, 22, 4, 20} / 30.0;

/// By how much each octave is moved against the one before, in its own lattice units.
inline constexpr DVec3 octave_shift{0.6180339887, 0.7548776662, 0.4142135624};

/// The fractal and its derivative at p (lattice units of the first octave). `spacing` is the
/// distance between samples, in the same units, for the fade of octaves; 0 keeps all. Throws
/// Error(input) if a parameter is out of range.
Sample2 fractal(const Fractal& f, DVec2 p, std::uint32_t seed, float spacing = 0);
Sample3 fractal(const Fractal& f, DVec3 p, std::uint32_t seed, float spacing = 0);

/// A fractal prepared for many calls from any thread: octave amplitudes and keys are worked out
/// once. Gives the same bits as `fractal`.
class FractalSampler {
 public:
  struct Octave {
    std::uint32_t key = 0;  ///< lattice_key of its seed
    float amplitude = 0;
    float frequency = 0;
    DMat2 matrix2{0};  ///< p_i = matrix · p + shift, in the plane
    DVec2 shift2{0};
    DMat3 matrix3{0};  ///< and in space
    DVec3 shift3{0};
  };

  /// Throws Error(input) if a parameter is out of range.
  FractalSampler(const Fractal& f, std::uint32_t seed);

  Sample2 operator()(DVec2 p, float spacing = 0) const;
  Sample3 operator()(DVec3 p, float spacing = 0) const;

  const Fractal& parameters() const { return fractal_; }
  const Octave& octave(int i) const { return octaves_[static_cast<std::size_t>(i)]; }
  /// The octaves before the first whose weight is zero at this spacing.
  int octaves_at(float spacing) const;

 private:
  Fractal fractal_;
  std::array<Octave, Fractal::max_octaves> octaves_{};
};

/// The weight of an octave whose lattice unit spans 1 / `spacing` samples.
float octave_weight(float spacing);

/// Bounds that the fractal never leaves, at any spacing. They are wide: values near them are rare.
struct FractalBounds {
  float low = 0;
  float high = 0;
};
FractalBounds bounds(const Fractal& f);

/// Fills a grid: sample (i, j) is the fractal at origin + step · (i, j). Vectorised; agrees with
/// `fractal` to 1e-5 of its range, and is the same for any number of threads. Octaves fade by
/// `step`.
void fill_fractal(GridView<float> out, const Fractal& f, DVec2 origin, double step,
                  std::uint32_t seed, Progress& progress);

/// One octave of noise over a grid, vectorised, as fill_fractal.
void fill_noise(GridView<float> out, NoiseBasis basis, DVec2 origin, double step,
                std::uint32_t seed, Progress& progress);

}  // namespace wold
