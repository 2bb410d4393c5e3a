#include "noise/fractal.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

#include "base/error.hpp"
#include "base/hash.hpp"

namespace wold {
namespace {

constexpr std::array kinds{FractalKind::fbm, FractalKind::hybrid, FractalKind::ridged,
                           FractalKind::turbulence, FractalKind::eroded};
constexpr std::array bases{NoiseBasis::gradient, NoiseBasis::value};

double random_double(int i, int axis, double reach) {
  return reach * (2 * uniform_double(random_bits(21, i, axis)) - 1);
}
DVec2 random_point2(int i, double reach) {
  return {random_double(i, 0, reach), random_double(i, 1, reach)};
}
DVec3 random_point3(int i, double reach) {
  return {random_double(i, 0, reach), random_double(i, 1, reach), random_double(i, 2, reach)};
}
std::uint32_t octave_seed(std::uint32_t seed, unsigned i) {
  return seed + i * 0x9e3779b9U;
}
DVec2 first_octave(DVec2 p) {
  return octave_turn2 * p + DVec2(octave_shift);
}
DVec2 second_octave(DVec2 p, double lacunarity) {
  return lacunarity * (octave_turn2 * first_octave(p)) + DVec2(octave_shift);
}
// A derivative by the place of an octave as one by p.
Vec2 turned_back(Vec2 derivative, int octave) {
  for (int i = 0; i <= octave; ++i) derivative = derivative * Mat2(octave_turn2);
  return derivative;
}

TEST(Fractal, FbmIsTheWeightedSumOfItsOctaves) {
  const Fractal f{.octaves = 2, .lacunarity = 2.5F, .hurst = 0.7F};
  for (int i = 0; i < 200; ++i) {
    const DVec2 p = random_point2(i, 50);
    const Sample2 a = gradient_noise(first_octave(p), octave_seed(5, 0));
    const Sample2 b = gradient_noise(second_octave(p, 2.5), octave_seed(5, 1));
    const Sample2 sum = fractal(f, p, 5);
    const float amplitude = std::pow(2.5F, -0.7F);
    EXPECT_NEAR(sum.value, a.value + amplitude * b.value, 1e-6);
    const Vec2 slope =
        turned_back(a.derivative, 0) + amplitude * 2.5F * turned_back(b.derivative, 1);
    EXPECT_NEAR(sum.derivative.x, slope.x, 1e-5);
    EXPECT_NEAR(sum.derivative.y, slope.y, 1e-5);
  }
}

TEST(Fractal, FormulasOfTheKinds) {
  for (int i = 0; i < 200; ++i) {
    const DVec2 p = random_point2(i, 50);
    const float n0 = gradient_noise(first_octave(p), octave_seed(5, 0)).value;
    const float n1 = gradient_noise(second_octave(p, 2), octave_seed(5, 1)).value;
    const float a1 = 0.5F;

    EXPECT_NEAR(fractal({.kind = FractalKind::turbulence, .octaves = 2}, p, 5).value,
                std::abs(n0) + a1 * std::abs(n1), 1e-6);

    const float h0 = n0 + 0.7F;
    EXPECT_NEAR(fractal({.kind = FractalKind::hybrid, .octaves = 2, .offset = 0.7F}, p, 5).value,
                h0 + std::min(h0, 1.0F) * a1 * (n1 + 0.7F), 1e-6);

    const float s0 = (1 - std::abs(n0)) * (1 - std::abs(n0));
    const float s1 = (1 - std::abs(n1)) * (1 - std::abs(n1)) * std::clamp(2 * s0, 0.0F, 1.0F);
    EXPECT_NEAR(fractal({.kind = FractalKind::ridged, .octaves = 2}, p, 5).value, s0 + a1 * s1,
                1e-6);

    const float k = 0.1F;
    const float m = 1 - std::sqrt(n0 * n0 + k * k);
    EXPECT_NEAR(
        fractal({.kind = FractalKind::ridged, .octaves = 1, .smooth_ridges = k}, p, 5).value, m * m,
        1e-6);

    const Vec2 d0 = turned_back(gradient_noise(first_octave(p), octave_seed(5, 0)).derivative, 0);
    const Vec2 d1 =
        d0 + turned_back(gradient_noise(second_octave(p, 2), octave_seed(5, 1)).derivative,
                         1);  // a_1 f_1 = 1
    EXPECT_NEAR(fractal({.kind = FractalKind::eroded, .octaves = 2, .damping = 3}, p, 5).value,
                n0 / (1 + 3 * glm::dot(d0, d0)) + a1 * n1 / (1 + 3 * glm::dot(d1, d1)), 2e-6);
  }
}

TEST(Fractal, DerivativesAgreeWithFiniteDifferences) {
  // Creases (|n|, clamp) between the two samples spoil a few points; those are told by a second
  // difference that is far too large.
  constexpr double h = 2e-4;
  for (const FractalKind kind : kinds)
    for (const NoiseBasis basis : bases) {
      const Fractal f{
          .kind = kind, .basis = basis, .octaves = 4, .offset = 0.9F, .smooth_ridges = 0.05F};
      int compared = 0;
      const auto compare = [&](double before, double here, double after, double derivative) {
        if (std::abs(after - 2 * here + before) / (h * h) > 400) return;
        ++compared;
        EXPECT_NEAR(derivative, (after - before) / (2 * h), 0.05) << static_cast<int>(kind);
      };
      for (int i = 0; i < 300; ++i) {
        const DVec2 p = random_point2(i, 20);
        const DVec3 q = random_point3(i, 20);
        for (int a = 0; a < 2; ++a) {
          DVec2 d(0);
          d[a] = h;
          const Sample2 here = fractal(f, p, 3);
          compare(fractal(f, p - d, 3).value, here.value, fractal(f, p + d, 3).value,
                  here.derivative[a]);
        }
        for (int a = 0; a < 3; ++a) {
          DVec3 d(0);
          d[a] = h;
          const Sample3 here = fractal(f, q, 3);
          compare(fractal(f, q - d, 3).value, here.value, fractal(f, q + d, 3).value,
                  here.derivative[a]);
        }
      }
      EXPECT_GT(compared, 1350) << static_cast<int>(kind);
    }
}

TEST(Fractal, StaysWithinItsBounds) {
  for (const FractalKind kind : kinds)
    for (const NoiseBasis basis : bases)
      for (const float hurst : {1.0F, 0.25F}) {
        const Fractal f{.kind = kind,
                        .basis = basis,
                        .hurst = hurst,
                        .offset = kind == FractalKind::hybrid ? 0.7F : 1.0F};
        const FractalBounds range = bounds(f);
        const FractalSampler sampler(f, 1);
        for (int i = 0; i < 5000; ++i) {
          const float spacing = i % 3 == 0 ? 0.1F : 0.0F;
          const float value = sampler(random_point2(i, 1000), spacing).value;
          EXPECT_GE(value, range.low);
          EXPECT_LE(value, range.high);
        }
      }
}

TEST(Fractal, OctavesFadeBelowTheSpacing) {
  EXPECT_EQ(octave_weight(0), 1);
  EXPECT_EQ(octave_weight(0.25F), 1);
  EXPECT_EQ(octave_weight(0.5F), 0);
  EXPECT_NEAR(octave_weight(1 / 3.0F), 0.5F, 1e-6);  // 1/spacing halfway from 2 to 4
  for (const FractalKind kind : kinds) {
    const Fractal all{.kind = kind, .octaves = 8};
    Fractal three = all;
    three.octaves = 3;
    const FractalSampler sampler(all, 2);
    EXPECT_EQ(sampler.octaves_at(0), 8);
    EXPECT_EQ(sampler.octaves_at(1 / 16.0F), 3);
    for (int i = 0; i < 100; ++i) {
      const DVec2 p = random_point2(i, 30);
      EXPECT_EQ(sampler(p, 1 / 16.0F).value, fractal(three, p, 2).value);
      // Continuous in the spacing: no octave appears at once.
      EXPECT_NEAR(sampler(p, 0.0621F).value, sampler(p, 0.0629F).value, 0.02);
    }
  }
}

TEST(Fractal, SamplerEqualsTheSingleCall) {
  const Fractal f{.kind = FractalKind::hybrid, .offset = 0.7F};
  const FractalSampler sampler(f, 77);
  for (int i = 0; i < 50; ++i) {
    EXPECT_EQ(sampler(random_point2(i, 9)).value, fractal(f, random_point2(i, 9), 77).value);
    EXPECT_EQ(sampler(random_point3(i, 9)).value, fractal(f, random_point3(i, 9), 77).value);
  }
}

TEST(Fractal, OriginIsNoZeroOfAllOctaves) {
  EXPECT_NE(fractal({.octaves = 2}, DVec2(0, 0), 1).value, 0);
  EXPECT_NE(fractal({.octaves = 2}, DVec3(0, 0, 0), 1).value, 0);
}

TEST(Fractal, OctavesAreTurnedNotStretched) {
  EXPECT_NEAR(glm::determinant(octave_turn2), 1, 1e-15);
  EXPECT_NEAR(glm::determinant(octave_turn3), 1, 1e-15);
  const DMat3 identity = octave_turn3 * glm::transpose(octave_turn3);
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) EXPECT_NEAR(identity[a][b], a == b ? 1 : 0, 1e-15);
  // No octave's lattice lies along an axis or along the octave before.
  DMat2 turn = octave_turn2;
  for (int i = 0; i < 12; ++i) {
    EXPECT_GT(std::min(std::abs(turn[0][0]), std::abs(turn[0][1])), 0.05) << i;
    turn = octave_turn2 * turn;
  }
}

TEST(Fractal, SaysWhatIsWrong) {
  const auto message = [](const Fractal& f) -> std::string {
    try {
      fractal(f, DVec2(0), 1);
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::input);
      return error.message();
    }
    return "";
  };
  EXPECT_EQ(message({.octaves = 33}), "a fractal has 0 to 32 octaves, not 33");
  EXPECT_EQ(message({.lacunarity = 0.5F}), "the lacunarity of a fractal is 1 to 16, not 0.5");
  EXPECT_EQ(message({.damping = -1}),
            "the parameters of a fractal are finite numbers, its damping not negative");
  EXPECT_EQ(message({}), "");
}

}  // namespace
}  // namespace wold
