#include "noise/noise.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/hash.hpp"
#include "noise/lattice.hpp"
#include "noise/noise_cell.hpp"

namespace wold {
namespace {

double random_double(std::uint64_t seed, int i, int axis, double low, double high) {
  return low + (high - low) * uniform_double(random_bits(seed, i, axis));
}
DVec2 random_point2(std::uint64_t seed, int i, double reach) {
  return {random_double(seed, i, 0, -reach, reach), random_double(seed, i, 1, -reach, reach)};
}
DVec3 random_point3(std::uint64_t seed, int i, double reach) {
  return {random_double(seed, i, 0, -reach, reach), random_double(seed, i, 1, -reach, reach),
          random_double(seed, i, 2, -reach, reach)};
}

// The greatest value that any choice of gradients gives at p in the unit cell.
template <int dimension>
double greatest_gradient_noise(const double (&p)[dimension]) {
  double total = 0;
  for (unsigned corner = 0; corner < (1U << dimension); ++corner) {
    double weight = 1;
    double offset[3] = {};
    for (int a = 0; a < dimension; ++a) {
      const double t = p[a];
      const double u = t * t * t * (t * (t * 6 - 15) + 10);
      const unsigned side = corner >> a & 1U;
      weight *= side != 0 ? u : 1 - u;
      offset[a] = t - side;
    }
    double best = 0;
    for (std::uint32_t h = 0; h < 32; ++h) {
      if constexpr (dimension == 2) {
        const Vec2 g = lattice_gradient2(h << 27U);
        best = std::max(best, g.x * offset[0] + g.y * offset[1]);
      } else {
        const Vec3 g = lattice_gradient3(h << 27U);
        best = std::max(best, g.x * offset[0] + g.y * offset[1] + g.z * offset[2]);
      }
    }
    total += weight * best;
  }
  return total;
}

TEST(Noise, IsZeroWithTheCornerGradientAtLatticePoints) {
  for (int i = -5; i < 5; ++i)
    for (int j = -5; j < 5; ++j) {
      const Sample2 s = gradient_noise(DVec2(i, j), 7);
      const Vec2 g = lattice_gradient2(
          lattice_hash(static_cast<std::uint32_t>(i),
                       lattice_line(static_cast<std::uint32_t>(j), lattice_key(7))));
      EXPECT_EQ(s.value, 0);
      EXPECT_EQ(s.derivative, g);
      const Sample3 s3 = gradient_noise(DVec3(i, j, 3), 7);
      EXPECT_EQ(s3.value, 0);
      EXPECT_NEAR(glm::length(s3.derivative), gradient3_scale, 1e-6);
    }
}

TEST(Noise, ValueNoiseIsTheHashAtLatticePointsAndFlatThere) {
  for (int i = -5; i < 5; ++i)
    for (int j = -5; j < 5; ++j) {
      const Sample2 s = value_noise(DVec2(i, j), 7);
      const std::uint32_t row = lattice_line(static_cast<std::uint32_t>(j), lattice_key(7));
      EXPECT_EQ(s.value, lattice_value(lattice_hash(static_cast<std::uint32_t>(i), row)));
      EXPECT_EQ(s.derivative, Vec2(0));
    }
}

TEST(Noise, ScaleOfGradientNoiseIsOneOverItsSupremum) {
  double greatest2 = 0;
  for (int i = 0; i <= 500; ++i)
    for (int j = 0; j <= 500; ++j)
      greatest2 = std::max(greatest2, greatest_gradient_noise<2>({i / 500.0, j / 500.0}));
  EXPECT_LT(greatest2, 1);
  EXPECT_GT(greatest2, 0.9999);
  double greatest3 = 0;
  for (int i = 0; i <= 40; ++i)
    for (int j = 0; j <= 40; ++j)
      for (int k = 0; k <= 40; ++k)
        greatest3 = std::max(greatest3, greatest_gradient_noise<3>({i / 40.0, j / 40.0, k / 40.0}));
  EXPECT_LT(greatest3, 1);
  EXPECT_GT(greatest3, 0.9999);
}

TEST(Noise, FillsItsRangeAndStaysWithin) {
  float low[4] = {};
  float high[4] = {};
  double mean[4] = {};
  constexpr int count = 400000;
  for (int i = 0; i < count; ++i) {
    const DVec2 p = random_point2(1, i, 1e6);
    const DVec3 q = random_point3(2, i, 1e6);
    const float n[4] = {gradient_noise(p, 3).value, value_noise(p, 3).value,
                        gradient_noise(q, 3).value, value_noise(q, 3).value};
    for (int k = 0; k < 4; ++k) {
      low[k] = std::min(low[k], n[k]);
      high[k] = std::max(high[k], n[k]);
      mean[k] += static_cast<double>(n[k]) / count;
    }
  }
  const float reached[4] = {0.95F, 0.97F, 0.65F, 0.9F};  // eight corners rarely agree
  for (int k = 0; k < 4; ++k) {
    EXPECT_GE(low[k], -1) << k;
    EXPECT_LE(high[k], 1) << k;
    EXPECT_LT(low[k], -reached[k]) << k;
    EXPECT_GT(high[k], reached[k]) << k;
    EXPECT_NEAR(mean[k], 0, 0.003) << k;
  }
}

TEST(Noise, DerivativesAgreeWithFiniteDifferences) {
  constexpr double h = 1e-3;
  for (int i = 0; i < 2000; ++i) {
    const DVec2 p = random_point2(4, i, 100);
    const DVec3 q = random_point3(5, i, 100);
    for (int basis = 0; basis < 2; ++basis) {
      const auto at2 = [&](DVec2 x) {
        return basis != 0 ? value_noise(x, 9) : gradient_noise(x, 9);
      };
      const auto at3 = [&](DVec3 x) {
        return basis != 0 ? value_noise(x, 9) : gradient_noise(x, 9);
      };
      for (int a = 0; a < 2; ++a) {
        DVec2 step(0);
        step[a] = h;
        const double slope =
            (static_cast<double>(at2(p + step).value) - at2(p - step).value) / (2 * h);
        EXPECT_NEAR(at2(p).derivative[a], slope, 2e-3) << basis << ' ' << p.x << ' ' << p.y;
      }
      for (int a = 0; a < 3; ++a) {
        DVec3 step(0);
        step[a] = h;
        const double slope =
            (static_cast<double>(at3(q + step).value) - at3(q - step).value) / (2 * h);
        EXPECT_NEAR(at3(q).derivative[a], slope, 2e-3) << basis;
      }
    }
  }
}

TEST(Noise, IsSmoothAcrossCells) {
  constexpr double h = 1e-7;
  for (int i = 0; i < 500; ++i) {
    const double along = random_double(6, i, 0, -50, 50);
    const double edge = std::floor(random_double(6, i, 1, -50, 50));
    for (const bool value : {false, true}) {
      const auto at = [&](DVec2 p) { return value ? value_noise(p, 1) : gradient_noise(p, 1); };
      for (const bool turned : {false, true}) {
        const Sample2 before = at(turned ? DVec2(edge - h, along) : DVec2(along, edge - h));
        const Sample2 after = at(turned ? DVec2(edge + h, along) : DVec2(along, edge + h));
        EXPECT_NEAR(before.value, after.value, 2e-6);
        EXPECT_NEAR(before.derivative.x, after.derivative.x, 1e-5);
        EXPECT_NEAR(before.derivative.y, after.derivative.y, 1e-5);
      }
    }
  }
}

TEST(Noise, KeepsItsDetailFarFromTheOrigin) {
  // Steps of 2^-10 of a feature at a million features: the slope must still be that of the noise.
  constexpr double h = 0x1p-10;
  for (int i = 0; i < 300; ++i) {
    const DVec2 p = DVec2(1e6, -1e6) + random_point2(7, i, 10);
    const double slope = (static_cast<double>(gradient_noise(p + DVec2(h, 0), 1).value) -
                          static_cast<double>(gradient_noise(p - DVec2(h, 0), 1).value)) /
                         (2 * h);
    EXPECT_NEAR(gradient_noise(p, 1).derivative.x, slope, 2e-3);
  }
}

TEST(Noise, HasNoMirrorAtZeroAndNoSharedSeeds) {
  double mirror_x = 0;
  double mirror_y = 0;
  double mirror_diagonal = 0;
  double seeds = 0;
  double self = 0;
  constexpr int count = 40000;
  for (int i = 0; i < count; ++i) {
    const DVec2 p = random_point2(8, i, 100);
    const double n = gradient_noise(p, 1).value;
    self += n * n;
    mirror_x += n * gradient_noise(DVec2(-p.x, p.y), 1).value;
    mirror_y += n * gradient_noise(DVec2(p.x, -p.y), 1).value;
    mirror_diagonal += n * gradient_noise(DVec2(p.y, p.x), 1).value;
    seeds += n * gradient_noise(p, 2).value;
  }
  for (const double correlation : {mirror_x, mirror_y, mirror_diagonal, seeds})
    EXPECT_NEAR(correlation / self, 0, 0.03);
}

TEST(Noise, SlopesAreEvenInAllDirections) {
  // E[cos 4θ] of the slope direction θ, weighted by the square of its length: 0 if no axis stands
  // out. Sampled at lattice points and everywhere.
  for (const bool on_lattice : {true, false}) {
    double sum = 0;
    double weight = 0;
    for (int i = 0; i < 200000; ++i) {
      DVec2 p = random_point2(9, i, 1e5);
      if (on_lattice) p = glm::floor(p);
      const Vec2 d = gradient_noise(p, 11).derivative;
      const float square = glm::dot(d, d);
      if (square == 0) continue;
      const float c = (d.x * d.x - d.y * d.y) / square;
      sum += square * (2 * c * c - 1);
      weight += square;
    }
    EXPECT_NEAR(sum / weight, 0, on_lattice ? 0.006 : 0.12) << on_lattice;
  }
}

}  // namespace
}  // namespace wold
