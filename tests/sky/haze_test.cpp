#include "sky/haze.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.hpp"
#include "sky/sky.hpp"

namespace wold {
namespace {

TEST(Haze, TwoPercentOfContrastIsLeftAtTheVisibility) {
  for (const double visibility : {500.0, 5000.0, 40000.0, 150000.0}) {
    const Haze haze(visibility, 1200);
    const float passed = haze.transmittance({0, 0, 0}, {1, 0, 0}, static_cast<float>(visibility)).y;
    EXPECT_NEAR(passed, 0.02F, 2e-4F);
  }
}

TEST(Haze, PathsMultiply) {
  const Haze haze(20000, 900);
  const Vec3 direction = glm::normalize(Vec3{0.6F, 0.5F, 0.3F});
  const Vec3 start{10, 20, 150};
  const Vec3 whole = haze.transmittance(start, direction, 3000);
  const Vec3 parts = haze.transmittance(start, direction, 1000) *
                     haze.transmittance(start + 1000.0F * direction, direction, 2000);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(whole[c], parts[c], 1e-5F);
  const Vec3 back = haze.transmittance(start + 3000.0F * direction, -direction, 3000);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(whole[c], back[c], 1e-5F);
}

TEST(Haze, BlueFadesFirstAndHeightIsClearer) {
  const Haze haze(40000, 1200);
  const Vec3 low = haze.transmittance({0, 0, 0}, {0, 1, 0}, 10000);
  const Vec3 high = haze.transmittance({0, 0, 3000}, {0, 1, 0}, 10000);
  EXPECT_LT(low.z, low.y);
  EXPECT_LT(low.y, low.x);
  EXPECT_GT(high.y, low.y);
}

TEST(Haze, IsFiniteInEveryDirectionAndDistance) {
  for (const double visibility : {10.0, 40000.0, 1e6}) {
    const Haze haze(visibility, 1);
    for (const float h : {-5000.0F, 0.0F, 9000.0F})
      for (float z = -1; z <= 1; z += 0.125F)
        for (const float distance : {0.0F, 1e-3F, 10.0F, 1e5F, INFINITY}) {
          const Vec3 direction{std::sqrt(1 - z * z), 0, z};
          const Vec3 t = haze.transmittance({0, 0, h}, direction, distance);
          for (int c = 0; c < 3; ++c) {
            ASSERT_GE(t[c], 0);
            ASSERT_LE(t[c], 1);
          }
        }
  }
}

TEST(Haze, NoneChangesNothing) {
  EXPECT_EQ(Haze().transmittance({0, 0, 0}, {1, 0, 0}, 1e6F), Vec3(1));
  SkySettings settings;
  settings.haze = false;
  EXPECT_EQ(Sky(settings).through_haze({1, 2, 3}, {0, 0, 0}, {1, 0, 0}, 1e6F), Vec3(1, 2, 3));
  EXPECT_THROW(Haze(0, 100), Error);
}

TEST(Haze, WhatIsInfinitelyFarLooksLikeTheSky) {
  const Sky sky;
  for (float azimuth = 0; azimuth < 6; azimuth += 0.7F)
    for (const float z : {-0.02F, 0.0F, 0.05F, 0.4F}) {
      const float across = std::sqrt(1 - z * z);
      const Vec3 direction{across * std::cos(azimuth), across * std::sin(azimuth), z};
      const Vec3 horizon{std::cos(azimuth), std::sin(azimuth), 0};
      // A black surface: a bright one would shine through what air there is above.
      const Vec3 seen = sky.through_haze(Vec3(0), {0, 0, 0}, direction, INFINITY);
      const Vec3 expected = sky.radiance(z > 0 ? direction : horizon);
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c] / expected[c], 1, 5e-3F);
    }
}

TEST(Haze, NearSurfacesAreNearlyUnchanged) {
  const Sky sky;
  const Vec3 leaf(800, 1200, 500);
  const Vec3 seen = sky.through_haze(leaf, {0, 0, 100}, glm::normalize(Vec3{1, 1, 0.2F}), 20);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], leaf[c], 40);
}

}  // namespace
}  // namespace wold
