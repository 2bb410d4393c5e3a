#include "sky/preetham.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sky/spectrum.hpp"

namespace wold {
namespace {

TEST(Preetham, ZenithOfThePaper) {
  const struct {
    double turbidity, sun_zenith, luminance, x, y;
  } cases[] = {{2, 60, 3.48733, 0.238013, 0.241988},
               {3, 45, 7.32036, 0.245678, 0.251476},
               {6, 30, 22.06671, 0.263127, 0.275985}};
  for (const auto& c : cases) {
    const SkyColour zenith = PreethamSky(c.turbidity, radians(c.sun_zenith)).zenith();
    EXPECT_NEAR(zenith.luminance, c.luminance, 1e-5);
    EXPECT_NEAR(zenith.x, c.x, 1e-6);
    EXPECT_NEAR(zenith.y, c.y, 1e-6);
  }
}

TEST(Preetham, StraightUpIsTheZenith) {
  const double sun_zenith = radians(50.0);
  const PreethamSky sky(3, sun_zenith);
  const SkyColour up = sky.colour(1, sun_zenith);
  EXPECT_NEAR(up.luminance, sky.zenith().luminance, 1e-12);
  EXPECT_NEAR(up.x, sky.zenith().x, 1e-12);
  EXPECT_NEAR(luminance(sky.radiance(1, sun_zenith)), 1000 * up.luminance, 1);
}

TEST(Preetham, BlueOverheadPalerAtTheHorizonBrighterAtTheSun) {
  const PreethamSky sky(2.5, radians(50.0));
  const DVec3 up = sky.radiance(1, radians(50.0));
  const DVec3 horizon = sky.radiance(0, radians(120.0));
  EXPECT_GT(up.z, 2 * up.x);
  EXPECT_LT(horizon.z / horizon.x, up.z / up.x);
  EXPECT_GT(luminance(horizon), luminance(up));
  EXPECT_GT(luminance(sky.radiance(0.6, 0.02)), 2 * luminance(sky.radiance(0.6, 1.5)));
}

TEST(Preetham, HorizonIsWhitishNotMauve) {
  for (const double turbidity : {2.0, 2.5, 3.0})
    for (const double gamma : {60.0, 90.0, 140.0}) {
      const DVec3 c = PreethamSky(turbidity, radians(50.0)).radiance(0.02, radians(gamma));
      EXPECT_GT(2 * c.y, 0.98 * (c.x + c.z)) << turbidity << " " << gamma;
    }
}

TEST(Preetham, NeverNegativeNorInfinite) {
  for (double turbidity = 1.9; turbidity <= 10; turbidity += 0.27)
    for (double sun = 0; sun <= 120; sun += 3)
      for (double theta = 0; theta <= 90; theta += 5)
        for (double gamma = 0; gamma <= 180; gamma += 10) {
          const PreethamSky sky(turbidity, radians(sun));
          const DVec3 c = sky.radiance(std::cos(radians(theta)), radians(gamma));
          ASSERT_TRUE(std::isfinite(c.x + c.y + c.z));
          ASSERT_GE(std::min({c.x, c.y, c.z}), 0);
          ASSERT_LT(luminance(c), 2e6) << turbidity << " " << sun << " " << theta << " " << gamma;
        }
}

}  // namespace
}  // namespace wold
