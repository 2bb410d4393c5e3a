#include <algorithm>
#include <cmath>

#include "noise/fractal.hpp"

namespace wold {
namespace {

FractalBounds times(const FractalBounds& a, const FractalBounds& b) {
  const auto [low, high] =
      std::minmax({a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high});
  return {low, high};
}

// Interval arithmetic along the recurrence of the hybrid multifractal, with n in [-1, 1].
FractalBounds hybrid_bounds(const Fractal& f, const FractalSampler& sampler) {
  FractalBounds total{0, 0};
  FractalBounds w{1, 1};
  for (int i = 0; i < f.octaves; ++i) {
    const float a = sampler.octave(i).amplitude;
    w = times(w, {a * (f.offset - 1), a * (f.offset + 1)});
    total.low += std::min(0.0F, w.low);
    total.high += std::max(0.0F, w.high);
    w = {std::min(w.low, 1.0F), std::min(w.high, 1.0F)};
  }
  return total;
}

}  // namespace

FractalBounds bounds(const Fractal& f) {
  const FractalSampler sampler(f, 0);
  if (f.kind == FractalKind::hybrid) return hybrid_bounds(f, sampler);
  float amplitudes = 0;
  for (int i = 0; i < f.octaves; ++i) amplitudes += sampler.octave(i).amplitude;
  switch (f.kind) {
    case FractalKind::ridged: {
      const float k = f.smooth_ridges;
      const float crest = f.offset - std::abs(k);
      const float foot = f.offset - std::sqrt(1 + k * k);
      return {0, amplitudes * std::max(crest * crest, foot * foot)};
    }
    case FractalKind::turbulence: return {0, amplitudes};
    default: return {-amplitudes, amplitudes};
  }
}

}  // namespace wold
