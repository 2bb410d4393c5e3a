#include "noise/fractal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "noise/lattice.hpp"
#include "noise/noise_cell.hpp"
#include "noise/noise_curvature.hpp"

namespace wold {
namespace {

using Octave = FractalSampler::Octave;

template <class Sample>
Sample scaled(const Sample& a, float k) {
  return {a.value * k, a.derivative * k};
}
template <class Sample>
Sample sum(const Sample& a, const Sample& b) {
  return {a.value + b.value, a.derivative + b.derivative};
}
template <class Sample>
Sample product(const Sample& a, const Sample& b) {
  return {a.value * b.value, a.value * b.derivative + b.value * a.derivative};
}
template <class Sample>
Sample absolute(const Sample& a, float k) {
  if (k == 0) return a.value < 0 ? scaled(a, -1) : a;
  const float root = std::sqrt(a.value * a.value + k * k);
  return {root, a.derivative * (a.value / root)};
}
template <class Sample>
Sample clamped(const Sample& a, float low, float high) {
  if (a.value < low) return {low};
  if (a.value > high) return {high};
  return a;
}

DVec2 place(const Octave& octave, DVec2 p) {
  return octave.matrix2 * p + octave.shift2;
}
DVec3 place(const Octave& octave, DVec3 p) {
  return octave.matrix3 * p + octave.shift3;
}
Mat2 matrix(const Octave& octave, DVec2 /*p*/) {
  return Mat2(octave.matrix2);
}
Mat3 matrix(const Octave& octave, DVec3 /*p*/) {
  return Mat3(octave.matrix3);
}

// The sums of each kind. `add` takes the octaves in order: n is the noise with its derivative by
// p, weight the fade.

template <class Sample>
struct FbmSum {
  explicit FbmSum(const Fractal& /*f*/) {}
  void add(const Sample& n, const Octave& octave, float weight) {
    total = sum(total, scaled(n, octave.amplitude * weight));
  }
  Sample total{};
};

template <class Sample>
struct TurbulenceSum {
  explicit TurbulenceSum(const Fractal& /*f*/) {}
  void add(const Sample& n, const Octave& octave, float weight) {
    total = sum(total, scaled(absolute(n, 0), octave.amplitude * weight));
  }
  Sample total{};
};

template <class Sample>
struct HybridSum {
  explicit HybridSum(const Fractal& f) : offset(f.offset) {}
  void add(Sample n, const Octave& octave, float weight) {
    n.value += offset;
    w = product(w, scaled(n, octave.amplitude));
    total = sum(total, scaled(w, weight));
    if (w.value > 1) w = {1};
  }
  float offset;
  Sample w{1};
  Sample total{};
};

template <class Sample>
struct RidgedSum {
  explicit RidgedSum(const Fractal& f) : offset(f.offset), gain(f.gain), k(f.smooth_ridges) {}
  void add(const Sample& n, const Octave& octave, float weight) {
    Sample crest = scaled(absolute(n, k), -1);
    crest.value += offset;
    const Sample s = product(product(crest, crest), w);
    total = sum(total, scaled(s, octave.amplitude * weight));
    w = clamped(scaled(s, gain), 0, 1);
  }
  float offset;
  float gain;
  float k;
  Sample w{1};
  Sample total{};
};

template <class Sum, NoiseBasis basis, class Sample, class Position>
Sample add_octaves(const FractalSampler& sampler, Position p, float spacing) {
  const Fractal& f = sampler.parameters();
  Sum sum(f);
  for (int i = 0; i < f.octaves; ++i) {
    const Octave& octave = sampler.octave(i);
    const float weight = octave_weight(spacing * octave.frequency);
    if (weight <= 0) break;
    Sample n = noise_cell::noise<basis>(place(octave, p), octave.key);
    n.derivative = n.derivative * matrix(octave, p);  // the transposed matrix times the derivative
    sum.add(n, octave, weight);
  }
  return sum.total;
}

// With d = Σ b_i ∇n_i, D its derivative (symmetric) and t = a n / q, q = 1 + c |d|²:
// ∇t = (a ∇n - t 2c D d) / q.
template <NoiseBasis basis, class Sample, class Position>
Sample add_eroded_octaves(const FractalSampler& sampler, Position p, float spacing) {
  const Fractal& f = sampler.parameters();
  using Vector = decltype(Sample::derivative);
  using Matrix = decltype(matrix(sampler.octave(0), p));
  Vector d{0};
  Matrix second{0};
  Sample total{};
  for (int i = 0; i < f.octaves; ++i) {
    const Octave& octave = sampler.octave(i);
    const float weight = octave_weight(spacing * octave.frequency);
    if (weight <= 0) break;
    const auto n = noise_cell::curvature<basis, Vector, Matrix>(place(octave, p), octave.key);
    const Matrix m = matrix(octave, p);
    const float a = octave.amplitude * weight;
    const Vector slope = a * (n.slope * m);
    d += slope;
    second += a * (glm::transpose(m) * n.second * m);
    const float damped = 1.0F / (1.0F + f.damping * glm::dot(d, d));
    const float term = a * n.value * damped;
    total.value += term;
    total.derivative += (slope - 2.0F * f.damping * term * (second * d)) * damped;
  }
  return total;
}

template <NoiseBasis basis, class Sample, class Position>
Sample evaluate_kind(const FractalSampler& sampler, Position p, float spacing) {
  switch (sampler.parameters().kind) {
    case FractalKind::fbm: return add_octaves<FbmSum<Sample>, basis, Sample>(sampler, p, spacing);
    case FractalKind::hybrid:
      return add_octaves<HybridSum<Sample>, basis, Sample>(sampler, p, spacing);
    case FractalKind::ridged:
      return add_octaves<RidgedSum<Sample>, basis, Sample>(sampler, p, spacing);
    case FractalKind::turbulence:
      return add_octaves<TurbulenceSum<Sample>, basis, Sample>(sampler, p, spacing);
    case FractalKind::eroded: return add_eroded_octaves<basis, Sample>(sampler, p, spacing);
  }
  throw Error(ErrorKind::internal, "unknown kind of fractal");
}

template <class Sample, class Position>
Sample evaluate(const FractalSampler& sampler, Position p, float spacing) {
  return sampler.parameters().basis == NoiseBasis::gradient
             ? evaluate_kind<NoiseBasis::gradient, Sample>(sampler, p, spacing)
             : evaluate_kind<NoiseBasis::value, Sample>(sampler, p, spacing);
}

void check(const Fractal& f) {
  if (f.octaves < 0 || f.octaves > Fractal::max_octaves)
    throw Error(ErrorKind::input, fmt::format("a fractal has 0 to {} octaves, not {}",
                                              Fractal::max_octaves, f.octaves));
  if (!(f.lacunarity >= 1 && f.lacunarity <= 16))
    throw Error(ErrorKind::input,
                fmt::format("the lacunarity of a fractal is 1 to 16, not {}", f.lacunarity));
  if (!std::isfinite(f.hurst) || !std::isfinite(f.offset) || !std::isfinite(f.gain) ||
      !std::isfinite(f.smooth_ridges) || !(f.damping >= 0 && std::isfinite(f.damping)))
    throw Error(ErrorKind::input,
                "the parameters of a fractal are finite numbers, its damping not negative");
}

}  // namespace

FractalSampler::FractalSampler(const Fractal& f, std::uint32_t seed) : fractal_(f) {
  check(f);
  const auto lacunarity = static_cast<double>(f.lacunarity);
  const double amplitude_ratio = std::pow(lacunarity, -static_cast<double>(f.hurst));
  double frequency = 1;
  double amplitude = 1;
  Octave octave{.matrix2 = octave_turn2,
                .shift2 = DVec2(octave_shift),
                .matrix3 = octave_turn3,
                .shift3 = octave_shift};
  for (int i = 0; i < f.octaves; ++i) {
    octave.key = lattice_key(seed + static_cast<std::uint32_t>(i) * 0x9e3779b9U);
    octave.amplitude = static_cast<float>(amplitude);
    octave.frequency = static_cast<float>(frequency);
    octaves_[static_cast<std::size_t>(i)] = octave;
    frequency *= lacunarity;
    amplitude *= amplitude_ratio;
    octave.matrix2 = lacunarity * (octave_turn2 * octave.matrix2);
    octave.shift2 = lacunarity * (octave_turn2 * octave.shift2) + DVec2(octave_shift);
    octave.matrix3 = lacunarity * (octave_turn3 * octave.matrix3);
    octave.shift3 = lacunarity * (octave_turn3 * octave.shift3) + octave_shift;
  }
}

Sample2 FractalSampler::operator()(DVec2 p, float spacing) const {
  return evaluate<Sample2>(*this, p, spacing);
}

Sample3 FractalSampler::operator()(DVec3 p, float spacing) const {
  return evaluate<Sample3>(*this, p, spacing);
}

int FractalSampler::octaves_at(float spacing) const {
  int i = 0;
  while (i < fractal_.octaves && octave_weight(spacing * octave(i).frequency) > 0) ++i;
  return i;
}

Sample2 fractal(const Fractal& f, DVec2 p, std::uint32_t seed, float spacing) {
  return FractalSampler(f, seed)(p, spacing);
}

Sample3 fractal(const Fractal& f, DVec3 p, std::uint32_t seed, float spacing) {
  return FractalSampler(f, seed)(p, spacing);
}

float octave_weight(float spacing) {
  if (spacing <= 0.25F) return 1;
  if (spacing >= 0.5F) return 0;
  const float t = 0.5F / spacing - 1.0F;
  return t * t * (3.0F - 2.0F * t);
}

}  // namespace wold
