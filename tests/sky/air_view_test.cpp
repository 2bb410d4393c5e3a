#include "sky/air_view.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/hash.hpp"
#include "base/parallel.hpp"
#include "sky/sky.hpp"
#include "sky/spectrum.hpp"

namespace wold {
namespace {

double lum(Vec3 rgb) {
  return luminance(DVec3(rgb));
}

Vec3 random_direction(int which) {
  const auto k = static_cast<std::uint64_t>(which);
  const float z = 2 * uniform(random_bits(5, k, 0)) - 1;
  const float turn = 2 * pi * uniform(random_bits(5, k, 1));
  const float across = std::sqrt(1 - z * z);
  return {across * std::cos(turn), across * std::sin(turn), z};
}

SkySettings with_sun(double elevation) {
  SkySettings settings;
  settings.model = SkyModel::atmosphere;
  settings.sun = {elevation, 200};
  return settings;
}

TEST(AirView, BetweenIsTheMarchInTheSameAir) {
  Atmosphere a;
  a.aerosol_scattering = Vec3(8e-5F);
  for (const double elevation : {50.0, 8.0}) {
    const Vec3 sun = sky_direction(elevation, 200);
    const AirView view(a, sun, Vec3(1e5F), 300);
    const SunlitAir air(a);
    for (int k = 0; k < 200; ++k) {
      Vec3 direction = random_direction(k);
      direction.z = 0.15F * direction.z;
      direction = glm::normalize(direction);
      const Vec3 origin{400, -300, 700};
      const float distance = 20000 * uniform(random_bits(9, static_cast<std::uint64_t>(k)));
      if (origin.z + direction.z * distance < 50) continue;
      const AirRay ray = air_ray(a, origin, direction, sun);
      const AirLight exact = with_phases(a, air.seen(ray, distance, 400), ray.to_sun, Vec3(1e5F));
      const AirLight fast = view.between(origin, direction, distance);
      for (int c = 0; c < 3; ++c) {
        ASSERT_NEAR(fast.transmittance[c], exact.transmittance[c], 0.003F);
        ASSERT_NEAR(fast.light[c] / exact.light[c], 1, 0.04F) << distance << " " << elevation;
      }
    }
  }
}

TEST(AirView, IsFiniteEverywhere) {
  for (const float scale : {1.0F, 1200.0F}) {
    Atmosphere a;
    a.aerosol_height = scale;
    const AirView view(a, sky_direction(3, 0), Vec3(1e5F), 0);
    for (const float z : {-5000.0F, 0.0F, 3000.0F, 5e5F})
      for (int k = 0; k < 50; ++k)
        for (const float distance : {0.0F, 1e-3F, 10.0F, 1e5F, INFINITY}) {
          const AirLight light = view.between({0, 0, z}, random_direction(k), distance);
          for (int c = 0; c < 3; ++c) {
            ASSERT_GE(light.transmittance[c], 0);
            ASSERT_LE(light.transmittance[c], 1);
            ASSERT_GE(light.light[c], 0);
            ASSERT_LT(light.light[c], 1e6F);
          }
        }
  }
}

TEST(AtmosphereSky, ClearDaysAndDuskAreAsBrightAsMeasured) {
  for (const double elevation : {10.0, 20.0, 40.0, 60.0, 80.0}) {
    const Sky sky(with_sun(elevation));
    const double measured = 800 + 15500 * std::sqrt(std::sin(radians(elevation)));
    EXPECT_NEAR(lum(sky.sky_irradiance()) / measured, 1, 0.3) << elevation;
  }
  const Sky noon(with_sun(60));
  EXPECT_GT(lum(noon.sun_irradiance()), 80e3);
  EXPECT_LT(lum(noon.sun_irradiance()), 115e3);
  EXPECT_NEAR(lum(Sky(with_sun(0)).sky_irradiance()), 600, 250);
  const double twilight = lum(Sky(with_sun(-6)).sky_irradiance());  // measured 3.4 lx
  EXPECT_GT(twilight, 2);
  EXPECT_LT(twilight, 7);
}

TEST(AtmosphereSky, DarkensSteadilyIntoNight) {
  double before = 1e9;
  for (double elevation = 30; elevation >= -40; elevation -= elevation > -12 ? 2 : 7) {
    const Sky sky(with_sun(elevation));
    for (int k = 0; k < 300; ++k) {
      const Vec3 c = sky.radiance(random_direction(k));
      ASSERT_TRUE(std::isfinite(c.x + c.y + c.z));
      ASSERT_GE(std::min({c.x, c.y, c.z}), 0);
    }
    const double now = lum(sky.sky_irradiance()) + lum(sky.sun_irradiance());
    EXPECT_LE(now, before * 1.001) << elevation;
    before = now;
  }
  EXPECT_GT(before, 1e-3);
}

TEST(AtmosphereSky, ColoursOfDayAndDusk) {
  const Sky noon(with_sun(60));
  const Vec3 zenith = noon.radiance({0, 0, 1});
  const Vec3 north = noon.radiance(sky_direction(2, 20));
  EXPECT_GT(zenith.z, 1.8F * zenith.x);
  EXPECT_GT(lum(north), 1.5 * lum(zenith));
  const Sky dusk(with_sun(-3));
  const Vec3 above = dusk.radiance({0, 0, 1});
  const Vec3 west = dusk.radiance(sky_direction(2, 200));
  EXPECT_GT(above.z, 1.5F * above.x);  // ozone
  EXPECT_GE(above.y, 0.9F * above.x);  // and not pink
  EXPECT_GT(west.x, 1.5F * west.z);
}

TEST(AtmosphereSky, HasNoLineAtTheHorizon) {
  for (const double elevation : {40.0, 2.0}) {
    const Sky sky(with_sun(elevation));
    for (int k = 0; k < 360; k += 5) {
      float before = 0;
      for (float e = -3; e <= 3; e += 0.1F) {
        const auto now = static_cast<float>(lum(sky.radiance(sky_direction(e, k))));
        if (before > 0) {
          EXPECT_NEAR(now / before, 1, 0.12F) << elevation << " " << e << " " << k;
        }
        before = now;
      }
    }
  }
}

TEST(AtmosphereSky, DistanceFadesIntoTheSkyBehind) {
  const Sky sky(with_sun(30));
  for (const double azimuth : {20.0, 110.0, 200.0}) {
    const Vec3 direction = sky_direction(0.3, azimuth);
    const Vec3 far = sky.through_haze(Vec3(0), {0, 0, 300}, direction, 3e5F);
    const Vec3 behind = sky.radiance(direction);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(far[c] / behind[c], 1, 0.1F) << azimuth;
  }
}

TEST(AtmosphereSky, FromSpaceAPlanetUnderABlackSky) {
  SkySettings settings = with_sun(50);
  settings.eye_height = 4e5F;
  const Sky sky(settings);
  EXPECT_LT(lum(sky.radiance({0, 0, 1})), 1);
  EXPECT_GT(lum(sky.radiance({0, 0, -1})), 3000);
  const Vec3 limb = sky.radiance(sky_direction(-19.2, 20));  // the edge lies 19.8° down
  EXPECT_GT(limb.z, 1.5F * limb.x);
  EXPECT_GT(lum(sky.sun_irradiance()), 125e3);
}

TEST(AtmosphereSky, NoHazeMeansNoAirBetweenSurfaces) {
  SkySettings settings = with_sun(40);
  settings.haze = false;
  const Sky sky(settings);
  EXPECT_FALSE(sky.has_air());
  EXPECT_EQ(sky.through_haze(Vec3(0.5F), {0, 0, 0}, {1, 0, 0}, 1e5F), Vec3(0.5F));
}

TEST(AtmosphereSky, SameBitsForAnyNumberOfThreads) {
  Vec3 reference{0};
  for (const int threads : {1, 2, 4}) {
    const ThreadLimit limit(threads);
    const Sky sky(with_sun(20));
    Vec3 sum = sky.sky_irradiance();
    for (int k = 0; k < 1000; ++k)
      sum += sky.through_haze(sky.radiance(random_direction(k)), {0, 0, 100}, random_direction(k),
                              5000);
    if (threads == 1) reference = sum;
    EXPECT_EQ(sum, reference);
  }
}

}  // namespace
}  // namespace wold
