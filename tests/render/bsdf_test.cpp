#include "render/bsdf.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "base/hash.hpp"

namespace wold {
namespace {

Vec2 random_pair(int k, int which) {
  return {uniform(random_bits(1, k, which, 0)), uniform(random_bits(1, k, which, 1))};
}

Vec3 sphere(Vec2 u) {
  const float z = 1 - 2 * u.x;
  const float r = std::sqrt(std::max(0.0F, 1 - z * z));
  return {r * std::cos(2 * pi * u.y), r * std::sin(2 * pi * u.y), z};
}

Bsdf surface(float cosine, Vec3 reflectance, Vec3 transmittance, float roughness) {
  const float sine = std::sqrt(1 - cosine * cosine);
  return {Vec3(0, 0, 1), Vec3(sine, 0, cosine), reflectance, transmittance, roughness};
}

TEST(Bsdf, DiffuseAlbedoIsReflectancePlusTransmittance) {
  const Bsdf b = surface(0.6F, Vec3(0.3F), Vec3(0.2F), 0);
  double sum = 0;
  constexpr int count = 200000;
  for (int k = 0; k < count; ++k)
    sum += static_cast<double>(b.evaluate(sphere(random_pair(k, 0))).x);
  EXPECT_NEAR(sum / count * 4 * pi_d, 0.5, 0.005);
}

TEST(Bsdf, NeverGivesBackMoreThanItGets) {
  for (const float roughness : {0.2F, 0.5F, 1.0F}) {
    for (const float cosine : {0.05F, 0.3F, 0.9F}) {
      const Bsdf b = surface(cosine, Vec3(0.7F), Vec3(0.3F), roughness);
      double sum = 0;
      constexpr int count = 40000;
      for (int k = 0; k < count; ++k) {
        const BsdfSample s = b.sample(random_pair(k, 0), uniform(random_bits(2, k)));
        if (s.pdf > 0) sum += static_cast<double>(s.weight.x);
      }
      EXPECT_LT(sum / count, 1.005) << roughness << ' ' << cosine;
    }
  }
}

/// χ² of sampled directions against the density, over cells of equal solid angle.
double chi_squared(const Bsdf& b, int& degrees_of_freedom) {
  constexpr int rows = 16;
  constexpr int columns = 24;
  constexpr int samples = 200000;
  std::array<double, rows * columns> expected{};
  std::array<double, rows * columns> observed{};
  const auto cell = [&](Vec3 d) {
    const int row = std::min(rows - 1, static_cast<int>((1 - d.z) / 2 * rows));
    float azimuth = std::atan2(d.y, d.x) / (2 * pi);
    if (azimuth < 0) azimuth += 1;
    return static_cast<std::size_t>(row * columns +
                                    std::min(columns - 1, static_cast<int>(azimuth * columns)));
  };
  constexpr int points = 40;  // per side of a cell, for the integral of the density
  for (int row = 0; row < rows * points; ++row)
    for (int column = 0; column < columns * points; ++column) {
      const Vec3 d = sphere({(static_cast<float>(row) + 0.5F) / (rows * points),
                             (static_cast<float>(column) + 0.5F) / (columns * points)});
      expected[cell(d)] +=
          static_cast<double>(b.pdf(d)) * 4 * pi_d / (rows * columns * points * points) * samples;
    }
  for (int k = 0; k < samples; ++k) {
    const BsdfSample s = b.sample(random_pair(k, 5), uniform(random_bits(6, k)));
    if (s.pdf > 0) observed[cell(s.direction)] += 1;
  }
  double sum = 0;
  degrees_of_freedom = 0;
  for (std::size_t k = 0; k < expected.size(); ++k) {
    if (expected[k] < 5) continue;
    ++degrees_of_freedom;
    sum += (observed[k] - expected[k]) * (observed[k] - expected[k]) / expected[k];
  }
  return sum;
}

TEST(Bsdf, SamplesFollowTheirDensity) {
  for (const float roughness : {0.0F, 0.4F, 0.8F}) {
    const Bsdf b = surface(0.55F, Vec3(0.2F), Vec3(0.25F), roughness);
    int freedom = 0;
    const double chi = chi_squared(b, freedom);
    EXPECT_LT(chi, freedom + 5 * std::sqrt(2.0 * freedom)) << "roughness " << roughness;
  }
}

TEST(Bsdf, WeightIsValueOverDensity) {
  const Bsdf b = surface(0.4F, Vec3(0.3F, 0.2F, 0.1F), Vec3(0.1F, 0.3F, 0.05F), 0.5F);
  for (int k = 0; k < 200; ++k) {
    const BsdfSample s = b.sample(random_pair(k, 0), uniform(random_bits(8, k)));
    if (!(s.pdf > 0)) continue;
    EXPECT_NEAR(s.pdf, b.pdf(s.direction), 1e-3F * s.pdf);
    const Vec3 expected = b.evaluate(s.direction) / s.pdf;
    EXPECT_NEAR(s.weight.y, expected.y, 1e-3F);
  }
}

}  // namespace
}  // namespace wold
