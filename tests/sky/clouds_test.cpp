#include "sky/clouds.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.hpp"
#include "base/hash.hpp"
#include "sky/phase_functions.hpp"
#include "sky/sky.hpp"
#include "sky/spectrum.hpp"

namespace wold {
namespace {

DVec2 random_place(int which) {
  const auto k = static_cast<std::uint64_t>(which);
  return 2e5 * DVec2(uniform(random_bits(2, k, 0)), uniform(random_bits(2, k, 1)));
}

/// Parts of columns with any cloud.
double covered(const CloudLayer& layer) {
  int sum = 0;
  constexpr int columns = 3000;
  for (int k = 0; k < columns; ++k) {
    bool any = false;
    for (int s = 1; s < 24 && !any; ++s)
      any = layer.density(
                random_place(k),
                layer.clouds().height + layer.clouds().thickness * static_cast<float>(s) / 24) > 0;
    sum += any;
  }
  return static_cast<double>(sum) / columns;
}

TEST(Clouds, CoverAsMuchOfTheSkyAsAsked) {
  Clouds clouds;
  clouds.billows = 0;
  double before = -1;
  for (const float coverage : {0.0F, 0.1F, 0.3F, 0.5F, 0.7F, 0.9F}) {
    clouds.coverage = coverage;
    const double share = covered(CloudLayer(clouds));
    EXPECT_NEAR(share, static_cast<double>(coverage), 0.12) << coverage;
    EXPECT_GT(share, before);
    before = share;
  }
  clouds.billows = 0.5F;
  EXPECT_LT(covered(CloudLayer(clouds)), before + 1e-9);
}

TEST(Clouds, LieInTheirLayerWithDensitiesUpToOne) {
  const CloudLayer layer(Clouds{});
  float most = 0;
  for (int k = 0; k < 20000; ++k) {
    const float height = 4000 * uniform(random_bits(8, static_cast<std::uint64_t>(k)));
    const float d = layer.density(random_place(k), height);
    ASSERT_GE(d, 0);
    ASSERT_LE(d, 1);
    if (height <= 1500 || height >= 2700) {
      ASSERT_EQ(d, 0);
    }
    most = std::max(most, d);
  }
  EXPECT_GT(most, 0.6F);
}

TEST(Clouds, AreDomesOnAFlatBase) {
  const CloudLayer layer(Clouds{});
  const auto share = [&](float height) {
    int sum = 0;
    for (int k = 0; k < 4000; ++k) sum += layer.density(random_place(k), height) > 0;
    return sum;
  };
  const int low = share(1600);
  EXPECT_GT(low, 1.6 * share(2300));
  EXPECT_GT(share(2300), share(2600));
}

TEST(Clouds, WorleyDistanceIsThatToTheNearestPoint) {
  double mean = 0;
  constexpr int n = 20000;
  for (int k = 0; k < n; ++k) {
    const DVec3 p{random_place(k) / 1e3, 17.3};
    const float d = worley_distance(p, 9);
    ASSERT_GE(d, 0);
    ASSERT_LE(d, 1);
    // No slope is steeper than 1.
    ASSERT_NEAR(worley_distance(p + DVec3{0.01, 0, 0}, 9), d, 0.0101F);
    mean += static_cast<double>(d) / n;
  }
  EXPECT_NEAR(mean, 0.52, 0.04);  // a little less than 0.554 Γ-law of points without a lattice
}

/// Everywhere as dense as can be: closed forms hold.
Clouds solid() {
  Clouds clouds;
  clouds.coverage = 1;
  clouds.billows = 0;
  clouds.thickness = 100;
  clouds.feature_size = 1e6F;
  clouds.scattering = 2e-4F;
  clouds.absorption = 1e-4F;
  clouds.orders = 1;
  return clouds;
}

TEST(Clouds, ThinEvenCloudFollowsBeerAndItsPhase) {
  const CloudLayer layer(solid());
  const Atmosphere a;
  // Mean density over the height, by fine steps, is what the march must see.
  float dense = 0;
  for (int k = 0; k < 4000; ++k)
    dense += layer.density({0, 0}, 1500 + 100 * (static_cast<float>(k) + 0.5F) / 4000) / 4000;
  ASSERT_GT(dense, 0.3F);
  const AirRay up{0, 1, 1, 1};
  const Vec3 zenith{0, 0, 1};
  const float depth = 3e-4F * 100 * dense;
  EXPECT_NEAR(layer.transmittance(a, {0, 0}, up, zenith, INFINITY, 400), std::exp(-depth), 2e-5F);
  const CloudLight light =
      layer.seen(a, {0, 0}, up, zenith, zenith, INFINITY, Vec3(1), Vec3(0), 0.5F, {200, 50});
  EXPECT_NEAR(light.transmittance, std::exp(-depth), 1e-4F);
  // Sun and eye in line: all light goes the whole depth, τ e^-τ.
  const float p = double_henyey_greenstein(1, 0.7F, -0.5F, 0.3F);
  EXPECT_NEAR(light.light.x / (2e-4F / 3e-4F * p * depth * std::exp(-depth)), 1, 0.01F);
}

TEST(Clouds, EachFurtherOrderHasHalfTheLightAndHalfTheDepth) {
  Clouds clouds = solid();
  clouds.scattering = 0.02F;
  clouds.absorption = 0;
  const Atmosphere a;
  const AirRay up{0, 1, 1, 1};
  const Vec3 zenith{0, 0, 1};
  const auto seen = [&](int orders) {
    clouds.orders = orders;
    return CloudLayer(clouds).seen(a, {0, 0}, up, zenith, zenith, INFINITY, Vec3(1), Vec3(0), 0.5F,
                                   {300, 100});
  };
  const CloudLight once = seen(1);
  const float depth = -std::log(once.transmittance);
  ASSERT_GT(depth, 0.7F);
  // Sun and eye in line: ∫ e^-t e^-((τ - t) / 2) dt.
  const float half = std::exp(-depth / 2);
  const float p = double_henyey_greenstein(1, 0.35F, -0.25F, 0.3F);
  EXPECT_NEAR((seen(2).light.x - once.light.x) / (0.5F * p * 2 * half * (1 - half)), 1, 0.02F);
}

TEST(Clouds, EvenLightFromAroundIsNeverExceeded) {
  Clouds clouds;
  clouds.coverage = 0.9F;
  const CloudLayer layer(clouds);
  const Atmosphere a;
  for (int k = 0; k < 50; ++k) {
    const Vec3 up = sky_direction(20 + k, 7 * k);
    const CloudLight light = layer.seen(a, random_place(k), air_ray(a, {0, 0, 0}, up, {0, 0, 1}),
                                        up, {0, 0, 1}, INFINITY, Vec3(0), Vec3(1), 0.5F);
    EXPECT_NEAR(light.light.x + light.transmittance, 1, 1e-4F);
  }
}

TEST(Clouds, SixtyFourByTwelveStepsAreNearlyTheWhole) {
  const CloudLayer layer(Clouds{});
  const Atmosphere a;
  const Vec3 sun = sky_direction(40, 200);
  double error = 0;
  double sum = 0;
  for (int k = 0; k < 60; ++k) {
    const Vec3 direction = sky_direction(35 + k % 40, 6 * k);
    const AirRay ray = air_ray(a, {0, 0, 0}, direction, sun);
    const auto seen = [&](float start, CloudSteps steps) {
      const CloudLight l = layer.seen(a, random_place(k), ray, direction, sun, INFINITY, Vec3(1e5F),
                                      Vec3(2000), start, steps);
      return static_cast<double>(l.light.x + 3000 * l.transmittance);
    };
    const double exact = seen(0.5F, {512, 32});
    error += std::abs(seen(0.5F, {64, 12}) - exact);
    sum += exact;
  }
  EXPECT_LT(error / sum, 0.04);
}

TEST(Clouds, SeenFromBelowWithinAndAbove) {
  const CloudLayer layer(solid());
  const Atmosphere a;
  const auto length = [&](float height, float cosine) {
    const AirSpan span = span_in_layer(a, height, cosine, 1500, 1600);
    return span.end - span.begin;
  };
  EXPECT_NEAR(length(0, 1), 100, 1);
  EXPECT_NEAR(length(1550, 1), 50, 1);
  EXPECT_NEAR(length(1550, -1), 50, 1);
  EXPECT_NEAR(length(9000, -1), 100, 1);
  EXPECT_EQ(length(0, -0.5F), 0);
  EXPECT_EQ(length(9000, 0.5F), 0);
  EXPECT_GT(length(0, 0.01F), 500);
  EXPECT_GT(layer.transmittance(a, {0, 0}, {0, -0.5F, 1, 1}, {0.8F, 0, -0.6F}, INFINITY, 20),
            0.99F);
}

TEST(CloudySky, WithoutCoverageIsTheClearOne) {
  SkySettings settings;
  settings.sun = {30, 200};
  const Sky clear(settings);
  settings.clouds.height = 500;
  const Sky same(settings);
  for (int k = 0; k < 100; ++k) {
    const Vec3 d = sky_direction(k % 90, 3.6 * k);
    ASSERT_EQ(same.radiance(d), clear.radiance(d));
    ASSERT_EQ(same.seen({0, 0, 2}, d, 0.5F), clear.radiance(d) + clear.sun_radiance(d));
  }
}

TEST(CloudySky, TableAndCameraSeeTheSameClouds) {
  for (const SkyModel model : {SkyModel::preetham, SkyModel::atmosphere}) {
    SkySettings settings;
    settings.model = model;
    settings.sun = {50, 200};
    settings.clouds.coverage = 0.5F;
    const Sky sky(settings);
    double table = 0;
    double camera = 0;
    constexpr int n = 3000;
    for (int k = 0; k < n; ++k) {
      const float u = uniform(random_bits(1, static_cast<std::uint64_t>(k)));
      const Vec3 d = sky_direction(10 + 79.0 * k / n, 137.508 * k);
      if (glm::dot(d, sky.sun_direction()) > 0.95F) continue;
      table += luminance(DVec3(sky.radiance(d)));
      camera += luminance(DVec3(sky.seen({0, 0, settings.eye_height}, d, u)));
    }
    EXPECT_NEAR(camera / table, 1, 0.03);
  }
}

TEST(CloudySky, OvercastHidesTheSunAndIsBrighterThanBlueSky) {
  SkySettings settings;
  settings.model = SkyModel::atmosphere;
  settings.sun = {50, 200};
  const Sky clear(settings);
  settings.clouds.coverage = 1;
  settings.clouds.billows = 0;
  const Sky overcast(settings);
  EXPECT_LT(overcast.sun_irradiance().y, 0.01F * clear.sun_irradiance().y);
  EXPECT_GT(overcast.sky_irradiance().y, 3000);
  EXPECT_LT(overcast.sky_irradiance().y, clear.sun_irradiance().y);
  const Vec3 zenith = overcast.radiance({0, 0, 1});
  EXPECT_LT(zenith.z, 1.7F * zenith.x);  // grey
}

TEST(Clouds, SayWhatIsWrong) {
  Clouds clouds;
  clouds.coverage = 1.5F;
  EXPECT_THROW(CloudLayer{clouds}, Error);
}

}  // namespace
}  // namespace wold
