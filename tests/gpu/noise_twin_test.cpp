// noise/*.glsl against noise/*.hpp: a million random points for each noise and kind of fractal.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "base/hash.hpp"
#include "base/parallel.hpp"
#include "gpu/context.hpp"
#include "gpu/evaluate.hpp"
#include "noise/fractal.hpp"
#include "noise/noise.hpp"

namespace wold {
namespace {

constexpr std::size_t point_count = 1'000'000;

/// In a cube from -reach to reach.
std::vector<Vec4> random_points(std::uint64_t seed, std::size_t count, float reach) {
  std::vector<Vec4> points(count);
  for (std::size_t k = 0; k < count; ++k)
    for (int c = 0; c < 4; ++c) points[k][c] = reach * (2 * uniform(random_bits(seed, k, c)) - 1);
  return points;
}

using Function = std::function<Vec4(DVec3, float)>;  // value and derivative, of a.xyz and a.w

Vec4 packed(const Sample2& s) {
  return {s.value, s.derivative, 0};
}
Vec4 packed(const Sample3& s) {
  return {s.value, s.derivative};
}

std::vector<Vec4> evaluate_points(const std::vector<Vec4>& points, const Function& function) {
  std::vector<Vec4> out(points.size());
  constexpr int chunk = 1 << 14;
  const int count = static_cast<int>(points.size());
  parallel_for(0, (count + chunk - 1) / chunk, [&](int task) {
    for (int k = task * chunk; k < std::min(count, (task + 1) * chunk); ++k) {
      const auto at = static_cast<std::size_t>(k);
      out[at] = function(DVec3(points[at]), points[at].w);
    }
  });
  return out;
}

/// How far `actual` is from `expected` in components [first, first + count), in parts of their
/// range.
struct Difference {
  float range = 0;
  float most = 0;                  ///< of those within `allowed`
  std::vector<std::size_t> large;  ///< the others
};
Difference difference(const std::vector<Vec4>& expected, const std::vector<Vec4>& actual, int first,
                      int count, float allowed = 1e-5F) {
  float low = INFINITY;
  float high = -INFINITY;
  for (const Vec4& e : expected)
    for (int c = first; c < first + count; ++c) {
      low = std::min(low, e[c]);
      high = std::max(high, e[c]);
    }
  Difference found;
  found.range = std::max(high - low, 1e-30F);
  for (std::size_t k = 0; k < expected.size(); ++k)
    for (int c = first; c < first + count; ++c) {
      const float d = std::abs(actual[k][c] - expected[k][c]) / found.range;
      if (d <= allowed) {
        found.most = std::max(found.most, d);
      } else {
        found.large.push_back(k);
        break;
      }
    }
  return found;
}

/// Whether the derivative is that of a place within 2e-6: at a crease, where rounding decides for
/// one side.
bool is_nearby(const Vec4& actual, const Vec4& point, float range, const Function& function) {
  for (int k = 0; k < 64; ++k) {
    DVec3 move;
    for (int c = 0; c < 3; ++c) move[c] = 4e-6 * (uniform_double(random_bits(1, k, c)) - 0.5);
    const Vec4 there = function(DVec3(point) + move, point.w);
    if (glm::length(Vec2(actual.y, actual.z) - Vec2(there.y, there.z)) < 1e-3F * range) return true;
  }
  return false;
}

class NoiseTwin : public testing::Test {
 protected:
  /// `expression` of p (vec2 or vec3) gives vec3 or vec4, `value` the value alone.
  void compare(const std::string& name, int dimension, const std::string& expression,
               const std::string& value, const std::vector<Vec4>& points, const Function& function,
               const std::string& declarations = {}) const {
    const std::string head = "#include \"noise/fractal.glsl\"\n" + declarations +
                             "vec4 evaluate(vec4 a, vec4 b) {\n  " +
                             (dimension == 2 ? "vec2 p = a.xy;" : "vec3 p = a.xyz;") + " return ";
    std::vector<Vec4> whole;
    std::vector<Vec4> alone;
    if (dimension == 2) {  // both at once
      whole = evaluate_shader(head + "vec4(" + expression + ", " + value + ");\n}\n", points);
      for (const Vec4& v : whole) alone.push_back({v.w, 0, 0, 0});
    } else {
      whole = evaluate_shader(head + expression + ";\n}\n", points);
      alone = evaluate_shader(head + "vec4(" + value + ");\n}\n", points);
    }
    const std::vector<Vec4> expected = evaluate_points(points, function);
    const Difference by_value = difference(expected, whole, 0, 1);
    const Difference by_value_alone = difference(expected, alone, 0, 1, allowed_alone_);
    const Difference by_derivative = difference(expected, whole, 1, dimension);
    RecordProperty(name + "_value", fmt::format("{:.2g}", by_value.most));
    RecordProperty(name + "_value_alone", fmt::format("{:.2g}", by_value_alone.most));
    RecordProperty(name + "_derivative", fmt::format("{:.2g}", by_derivative.most));
    RecordProperty(name + "_creases", static_cast<int>(by_derivative.large.size()));
    EXPECT_TRUE(by_value.large.empty()) << name << ' ' << by_value.large.size();
    EXPECT_TRUE(by_value_alone.large.empty()) << name << ' ' << by_value_alone.large.size();
    ASSERT_LE(by_derivative.large.size(), points.size() / 50000) << name;
    for (const std::size_t k : by_derivative.large)
      EXPECT_TRUE(is_nearby(whole[k], points[k], by_derivative.range, function))
          << name << ' ' << k;
  }

  void compare_fractal(const std::string& name, const Fractal& f, int dimension,
                       const std::vector<Vec4>& points, bool spaced = false) const {
    constexpr std::uint32_t seed = 0xfedcba98U;
    const std::string declarations = fmt::format(
        "Fractal f() {{ return Fractal({}, {}, {}, {:#}, {:#}, {:#}, {:#}, {:#}, {:#}); }}\n",
        static_cast<int>(f.kind), static_cast<int>(f.basis), f.octaves, f.lacunarity, f.hurst,
        f.offset, f.gain, f.smooth_ridges, f.damping);
    const FractalSampler sampler(f, seed);
    const Function function = [&](DVec3 p, float w) {
      const float spacing = spaced ? w : 0;
      return dimension == 2 ? packed(sampler(DVec2(p), spacing)) : packed(sampler(p, spacing));
    };
    const std::string arguments = fmt::format("(p, f(), {}u, {})", seed, spaced ? "a.w" : "0.0");
    compare(
        fmt::format("{}_{}_{}d", kind_names.at(static_cast<std::size_t>(f.kind)), name, dimension),
        dimension, "fractal" + arguments, "fractal_value" + arguments, points, function,
        declarations);
  }

  static constexpr std::array kind_names{"fbm", "hybrid", "ridged", "turbulence", "eroded"};
  OffscreenContext context_;
  float allowed_alone_ = 1e-5F;  // of values by the quicker walk
};

constexpr std::array kinds{FractalKind::fbm, FractalKind::hybrid, FractalKind::ridged,
                           FractalKind::turbulence, FractalKind::eroded};

TEST_F(NoiseTwin, NoiseAgrees) {
  const std::vector<Vec4> points = random_points(3, point_count, 16);
  constexpr std::uint32_t seed = 0x89abcdefU;
  const std::string arguments = fmt::format("(p, {}u)", seed);
  const auto check = [&](const std::string& name, int dimension, const Function& function) {
    compare(fmt::format("{}_{}d", name, dimension), dimension, name + arguments,
            name + "_value" + arguments, points, function);
  };
  check("value_noise", 2, [](DVec3 p, float) { return packed(value_noise(DVec2(p), seed)); });
  check("gradient_noise", 2, [](DVec3 p, float) { return packed(gradient_noise(DVec2(p), seed)); });
  check("value_noise", 3, [](DVec3 p, float) { return packed(value_noise(p, seed)); });
  check("gradient_noise", 3, [](DVec3 p, float) { return packed(gradient_noise(p, seed)); });
}

TEST_F(NoiseTwin, FractalsOfThePlaneAgree) {
  const std::vector<Vec4> points = random_points(4, point_count, 16);
  for (const FractalKind kind : kinds) compare_fractal("gradient", {.kind = kind}, 2, points);
}

TEST_F(NoiseTwin, FractalsOfSpaceAgree) {
  const std::vector<Vec4> points = random_points(5, point_count, 16);
  for (const FractalKind kind : kinds) compare_fractal("gradient", {.kind = kind}, 3, points);
}

TEST_F(NoiseTwin, FractalsOfValueNoiseWithOtherParametersAgree) {
  const std::vector<Vec4> points = random_points(6, 100'000, 16);
  for (const FractalKind kind : kinds)
    for (const int dimension : {2, 3})
      compare_fractal("value",
                      {.kind = kind,
                       .basis = NoiseBasis::value,
                       .octaves = 8,
                       .lacunarity = 2.17F,
                       .hurst = 0.7F,
                       .offset = 0.8F,
                       .gain = 1.7F,
                       .smooth_ridges = 0.05F,
                       .damping = 0.5F},
                      dimension, points);
}

TEST_F(NoiseTwin, FractalsAgreeFarFromTheOrigin) {
  allowed_alone_ = 3e-4F;
  const std::vector<Vec4> points = random_points(7, 50'000, 500);
  for (const FractalKind kind : kinds)
    for (const int dimension : {2, 3}) compare_fractal("far", {.kind = kind}, dimension, points);
}

TEST_F(NoiseTwin, OctavesFadeAlike) {
  std::vector<Vec4> points = random_points(8, 100'000, 16);
  for (std::size_t k = 0; k < points.size(); ++k)
    points[k].w = std::pow(2.0F, -11 * uniform(random_bits(12, k)));
  for (const FractalKind kind : kinds) compare_fractal("spaced", {.kind = kind}, 2, points, true);
}

TEST_F(NoiseTwin, PlacesInMetresKeepTheirDetail) {
  std::vector<Vec4> points = random_points(9, 100'000, 1e5F);
  const auto function = [](DVec3 p, float) {
    return packed(FractalSampler({}, 1)(DVec2(p) / 2500.0));
  };
  compare("metres", 2, "fbm(lattice_place(p, 2500.0), default_fractal(), 1u, 10, 0.0)",
          "fbm_value(lattice_place(p, 2500.0), default_fractal(), 1u, 10, 0.0)", points, function);
}

TEST(NoiseTwinEs, FractalsAgreeInOpenGlEs) {
  const OffscreenContext context({.es = true});
  const std::vector<Vec4> points = random_points(10, 10'000, 16);
  const auto out = evaluate_shader(
      "#include \"noise/fractal.glsl\"\n"
      "vec4 evaluate(vec4 a, vec4 b) { return fractal(a.xyz, default_fractal(), 3u, 0.0); }\n",
      points);
  const FractalSampler sampler({}, 3);
  const auto expected = evaluate_points(points, [&](DVec3 p, float) { return packed(sampler(p)); });
  EXPECT_TRUE(difference(expected, out, 0, 1).large.empty());
  EXPECT_TRUE(difference(expected, out, 1, 3).large.empty());
}

}  // namespace
}  // namespace wold
