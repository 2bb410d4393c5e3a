// What one octave adds to the samples of a tile, on vectors: see fractal_fill.cpp. Included once
// per target of Highway, after foreach_target.h.

#if defined(WOLD_NOISE_TILE_SUM_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef WOLD_NOISE_TILE_SUM_INL
#undef WOLD_NOISE_TILE_SUM_INL
#else
#define WOLD_NOISE_TILE_SUM_INL
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <cstddef>

#include "noise/fractal.hpp"
#include "noise/tile_lattice-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace wold::HWY_NAMESPACE {
namespace {

/// The noise and, if asked for, its slope in lattice coordinates.
struct VectorSample {
  FloatVector value, slope_x, slope_y;
};

/// The place of a lane in its cell.
struct Fractions {
  FloatVector x, y;
};

template <bool with_slope, class Picker>
HWY_INLINE VectorSample gradient_sample(Fractions t, const Picker& x, const Picker& y,
                                        SignedVector index) {
  const auto one = hn::Set(Floats(), 1.0F);
  const auto left = hn::Sub(t.x, one);
  const auto below = hn::Sub(t.y, one);
  const auto x00 = x.pick(index, 0, 0);
  const auto x10 = x.pick(index, 1, 0);
  const auto x01 = x.pick(index, 0, 1);
  const auto x11 = x.pick(index, 1, 1);
  const auto y00 = y.pick(index, 0, 0);
  const auto y10 = y.pick(index, 1, 0);
  const auto y01 = y.pick(index, 0, 1);
  const auto y11 = y.pick(index, 1, 1);
  const auto n00 = hn::MulAdd(x00, t.x, hn::Mul(y00, t.y));
  const auto n10 = hn::MulAdd(x10, left, hn::Mul(y10, t.y));
  const auto n01 = hn::MulAdd(x01, t.x, hn::Mul(y01, below));
  const auto n11 = hn::MulAdd(x11, left, hn::Mul(y11, below));
  const auto u = fade(t.x);
  const auto v = fade(t.y);
  const auto low = lerp(n00, n10, u);
  const auto high = lerp(n01, n11, u);
  VectorSample n{lerp(low, high, v), u, v};
  if constexpr (with_slope) {
    const auto across = lerp(hn::Sub(n10, n00), hn::Sub(n11, n01), v);
    n.slope_x = hn::MulAdd(fade_slope(t.x), across, lerp(lerp(x00, x10, u), lerp(x01, x11, u), v));
    n.slope_y = hn::MulAdd(fade_slope(t.y), hn::Sub(high, low),
                           lerp(lerp(y00, y10, u), lerp(y01, y11, u), v));
  }
  return n;
}

template <bool with_slope, class Picker>
HWY_INLINE VectorSample value_sample(Fractions t, const Picker& a, SignedVector index) {
  const auto a00 = a.pick(index, 0, 0);
  const auto a10 = a.pick(index, 1, 0);
  const auto a01 = a.pick(index, 0, 1);
  const auto a11 = a.pick(index, 1, 1);
  const auto u = fade(t.x);
  const auto v = fade(t.y);
  const auto low = lerp(a00, a10, u);
  const auto high = lerp(a01, a11, u);
  VectorSample n{lerp(low, high, v), u, v};
  if constexpr (with_slope) {
    const auto across = lerp(hn::Sub(a10, a00), hn::Sub(a11, a01), v);
    n.slope_x = hn::Mul(fade_slope(t.x), across);
    n.slope_y = hn::Mul(fade_slope(t.y), hn::Sub(high, low));
  }
  return n;
}

/// The vector of a block whose lanes in row r are all values[r].
HWY_INLINE FloatVector each_four(const float* values) {
  alignas(64) std::array<float, HWY_MAX_BYTES / sizeof(float) + block_columns> lanes;
  for (int r = 0; r < block_rows(); ++r)
    std::fill_n(&lanes[static_cast<std::size_t>(r) * block_columns], block_columns, values[r]);
  return hn::Load(Floats(), lanes.data());
}

constexpr std::size_t strip_rows = 16;  // so that the sums stay in the nearest cache
constexpr std::size_t strip_samples = tile_columns * strip_rows;

/// What the samples of a strip of a tile have gathered, block after block.
struct Sums {
  alignas(64) std::array<float, strip_samples> total;
  alignas(64) std::array<float, strip_samples> w;  // of hybrid and ridged
  alignas(64) std::array<float, strip_samples> slope_x;
  alignas(64) std::array<float, strip_samples> slope_y;
};

/// One octave as its sum sees it.
struct Term {
  Term(const Fractal& f, const FractalSampler::Octave& octave, float octave_weight)
      : amplitude(octave.amplitude),
        weight(octave_weight),
        offset(f.offset),
        gain(std::max(f.gain, 0.0F)),
        smooth(f.smooth_ridges),
        damping(f.damping),
        matrix(octave.matrix2) {}

  float amplitude, weight, offset, gain, smooth, damping;
  Mat2 matrix;
};

/// Adds one octave to the samples from `at` on: see the sums of fractal.cpp.
template <FractalKind kind>
HWY_INLINE void add_term(const Term& term, VectorSample n, Sums& sums, std::size_t at) {
  const Floats d;
  float* total = &sums.total[at];
  const auto scale = hn::Set(d, term.amplitude * term.weight);
  const auto add = [&](FloatVector value, FloatVector factor) HWY_ATTR {
    hn::Store(hn::MulAdd(value, factor, hn::Load(d, total)), d, total);
  };
  if constexpr (kind == FractalKind::fbm) {
    add(n.value, scale);
  } else if constexpr (kind == FractalKind::turbulence) {
    add(hn::Abs(n.value), scale);
  } else if constexpr (kind == FractalKind::hybrid) {
    const auto height = hn::Add(n.value, hn::Set(d, term.offset));
    const auto w = hn::Mul(hn::Load(d, &sums.w[at]), hn::Mul(height, hn::Set(d, term.amplitude)));
    add(w, hn::Set(d, term.weight));
    hn::Store(hn::Min(w, hn::Set(d, 1.0F)), d, &sums.w[at]);
  } else if constexpr (kind == FractalKind::ridged) {
    const float k = term.smooth;
    const auto rounded = [&]() HWY_ATTR {
      return hn::Sqrt(hn::MulAdd(n.value, n.value, hn::Set(d, k * k)));
    };
    const auto crest = hn::Sub(hn::Set(d, term.offset), k == 0 ? hn::Abs(n.value) : rounded());
    const auto s = hn::Mul(hn::Mul(crest, crest), hn::Load(d, &sums.w[at]));
    add(s, scale);
    const auto w = hn::Mul(s, hn::Set(d, term.gain));
    hn::Store(hn::Min(w, hn::Set(d, 1.0F)), d, &sums.w[at]);  // s is not negative
  } else {
    const Mat2& m = term.matrix;
    const auto a = hn::Mul(n.slope_x, scale);
    const auto b = hn::Mul(n.slope_y, scale);
    auto x = hn::Load(d, &sums.slope_x[at]);
    auto y = hn::Load(d, &sums.slope_y[at]);
    x = hn::MulAdd(a, hn::Set(d, m[0][0]), hn::MulAdd(b, hn::Set(d, m[0][1]), x));
    y = hn::MulAdd(a, hn::Set(d, m[1][0]), hn::MulAdd(b, hn::Set(d, m[1][1]), y));
    hn::Store(x, d, &sums.slope_x[at]);
    hn::Store(y, d, &sums.slope_y[at]);
    const auto square = hn::MulAdd(x, x, hn::Mul(y, y));
    const auto one = hn::Set(d, 1.0F);
    const auto damped = hn::Div(one, hn::MulAdd(square, hn::Set(d, term.damping), one));
    add(hn::Mul(n.value, scale), damped);
  }
}

}  // namespace
}  // namespace wold::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
