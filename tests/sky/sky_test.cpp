#include "sky/sky.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/hash.hpp"
#include "base/parallel.hpp"
#include "sky/preetham.hpp"
#include "sky/spectrum.hpp"

namespace wold {
namespace {

double lum(Vec3 rgb) {
  return luminance(DVec3(rgb));
}

SkySettings with_sun(double elevation, double azimuth = 200) {
  SkySettings settings;
  settings.sun = {elevation, azimuth};
  return settings;
}

Vec2 random_point(int which) {
  const auto k = static_cast<std::uint64_t>(which);
  return {uniform(random_bits(7, k, 0)), uniform(random_bits(7, k, 1))};
}

Vec3 uniform_direction(int which) {
  const Vec2 u = random_point(which);
  const float z = 2 * u.x - 1;
  const float across = std::sqrt(1 - z * z);
  return {across * std::cos(2 * pi * u.y), across * std::sin(2 * pi * u.y), z};
}

TEST(Sky, TableIsPreethamTimesAConstantWithinHalfAPercent) {
  const Sky sky(with_sun(40));
  const PreethamSky exact(SkySettings{}.turbidity, radians(50.0));
  double worst = 0;
  for (int k = 0; k < 20000; ++k) {
    const Vec3 d = uniform_direction(k);
    if (d.z < 0) continue;
    const double gamma = std::acos(glm::dot(DVec3(d), DVec3(sky.sun_direction())));
    if (gamma < 0.02) continue;
    const DVec3 truth = 0.55 * exact.radiance(d.z, gamma);
    for (int c = 0; c < 3; ++c)
      worst = std::max(worst, std::abs(static_cast<double>(sky.radiance(d)[c]) / truth[c] - 1));
  }
  EXPECT_LT(worst, 0.005);
}

TEST(Sky, ClearNoonIsAsBrightAsMeasured) {
  const Sky sky(with_sun(60));
  const double sun = lum(sky.sun_irradiance());
  const double dome = lum(sky.sky_irradiance());
  EXPECT_GT(sun, 80e3);
  EXPECT_LT(sun, 115e3);
  EXPECT_GT(dome, 9e3);
  EXPECT_LT(dome, 22e3);
}

TEST(Sky, DomeFollowsTheFormulaOfTheIesDownToTwilight) {
  for (const double elevation : {10.0, 20.0, 40.0, 60.0, 80.0}) {
    const double measured = 800 + 15500 * std::sqrt(std::sin(radians(elevation)));
    EXPECT_NEAR(lum(Sky(with_sun(elevation)).sky_irradiance()) / measured, 1, 0.2) << elevation;
  }
  EXPECT_NEAR(lum(Sky(with_sun(0)).sky_irradiance()), 600, 150);
  EXPECT_NEAR(lum(Sky(with_sun(-6)).sky_irradiance()), 3.4, 2);
}

TEST(Sky, SmoothAcrossTheHorizonAndTheSeamOfAzimuth) {
  const Sky sky(with_sun(25));
  for (int k = 0; k < 360; ++k) {
    const float a = radians(static_cast<float>(k));
    const auto at = [&](float z) { return lum(sky.radiance({std::cos(a), std::sin(a), z})); };
    EXPECT_NEAR(at(1e-4F) / at(-1e-4F), 1, 1e-3);
    EXPECT_NEAR(at(5e-3F) / at(-5e-3F), 1, 0.1);
  }
  const auto near_seam = [&](float y) {
    return lum(sky.radiance(glm::normalize(Vec3{1, y, 0.3F})));
  };
  EXPECT_NEAR(near_seam(1e-6F) / near_seam(-1e-6F), 1, 1e-4);
}

TEST(Sky, DarkensSteadilyIntoNightWithoutNegativeOrInfiniteLight) {
  double before = 1e9;
  for (double elevation = 20; elevation >= -90; elevation -= elevation > -20 ? 0.5 : 10) {
    const Sky sky(with_sun(elevation));
    for (int k = 0; k < 300; ++k) {
      const Vec3 c = sky.radiance(uniform_direction(k));
      ASSERT_TRUE(std::isfinite(c.x + c.y + c.z));
      ASSERT_GE(std::min({c.x, c.y, c.z}), 0);
    }
    const double now = lum(sky.sky_irradiance()) + lum(sky.sun_irradiance());
    ASSERT_LE(now, before * 1.001) << elevation;
    before = now;
    EXPECT_EQ(sky.sun_visible(), elevation > -0.265) << elevation;
  }
  const Sky night(with_sun(-40));
  EXPECT_GT(lum(night.sky_irradiance()), 1e-3);
  EXPECT_LT(lum(night.sky_irradiance()), 1e-2);
  EXPECT_GT(night.radiance({0, 0, 1}).z, night.radiance({0, 0, 1}).x);
  EXPECT_EQ(night.sun_radiance(night.sun_direction()), Vec3(0));
  EXPECT_EQ(night.sample_sun({0.5F, 0.5F}).pdf, 0);
}

TEST(Sky, DensityIntegratesToOne) {
  for (const double elevation : {50.0, 3.0, -10.0}) {
    const Sky sky(with_sun(elevation));
    // Midpoints of a fine grid in azimuth and the sine of elevation; the rows of the table are not
    // its rows, so this is the density as a caller meets it.
    constexpr int fine = 4000;
    const double sum = parallel_reduce(
        0, fine, 0.0,
        [&](int j) {
          const float z = 2 * (static_cast<float>(j) + 0.5F) / fine - 1;
          double row = 0;
          for (int i = 0; i < 512; ++i) {
            const float a = 2 * pi * (static_cast<float>(i) + 0.5F) / 512;
            const float across = std::sqrt(1 - z * z);
            row +=
                static_cast<double>(sky.sky_pdf({across * std::cos(a), across * std::sin(a), z}));
          }
          return row;
        },
        [](double a, double b) { return a + b; });
    EXPECT_NEAR(sum * 4 * pi_d / (fine * 512.0), 1, 0.002);
  }
}

/// χ² of samples against the density, over bins of equal solid angle. The density within a bin
/// comes from uniform directions.
TEST(Sky, SamplesFollowTheDensity) {
  const Sky sky(with_sun(30));
  constexpr int bins_z = 20;
  constexpr int bins_a = 24;
  const auto bin = [](Vec3 d) {
    const float turn = std::atan2(d.y, d.x) / (2 * pi);
    const int a = std::min(static_cast<int>((turn < 0 ? turn + 1 : turn) * bins_a), bins_a - 1);
    const int z = std::min(static_cast<int>((d.z + 1) / 2 * bins_z), bins_z - 1);
    const int index = z * bins_a + a;
    return static_cast<std::size_t>(index);
  };
  constexpr int samples = 200000;
  std::vector<double> observed(bins_z * bins_a), expected(bins_z * bins_a);
  for (int k = 0; k < samples; ++k) {
    const SkySample s = sky.sample_sky(random_point(k));
    ASSERT_NEAR(glm::length(s.direction), 1, 1e-5);
    ASSERT_EQ(s.radiance, sky.radiance(s.direction));
    observed[bin(s.direction)] += 1;
  }
  constexpr int fine = 40;  // midpoints across a bin, per axis
  for (int z = 0; z < bins_z * fine; ++z)
    for (int a = 0; a < bins_a * fine; ++a) {
      const float sine = 2 * (static_cast<float>(z) + 0.5F) / (bins_z * fine) - 1;
      const float angle = 2 * pi * (static_cast<float>(a) + 0.5F) / (bins_a * fine);
      const float across = std::sqrt(1 - sine * sine);
      const Vec3 d{across * std::cos(angle), across * std::sin(angle), sine};
      expected[bin(d)] += static_cast<double>(sky.sky_pdf(d)) * samples * 4 * pi_d /
                          (bins_z * fine * bins_a * fine);
    }
  double chi_2 = 0;
  int used = 0;
  for (std::size_t b = 0; b < observed.size(); ++b)
    if (expected[b] > 5) {
      chi_2 += (observed[b] - expected[b]) * (observed[b] - expected[b]) / expected[b];
      ++used;
    }
  EXPECT_GT(used, 300);
  EXPECT_LT(chi_2, used + 5 * std::sqrt(2.0 * used));
}

TEST(Sky, FewSamplesFallBelowTheHorizon) {
  const Sky sky(with_sun(40));
  int below = 0;
  for (int k = 0; k < 10000; ++k) below += sky.sample_sky(random_point(k)).direction.z < 0;
  EXPECT_GT(below, 100);
  EXPECT_LT(below, 1500);
}

TEST(Sky, PdfOfASampleIsThePdfOfItsDirection) {
  const Sky sky(with_sun(30));
  int differ = 0;
  for (int k = 0; k < 10000; ++k) {
    const SkySample s = sky.sample_sky(random_point(k));
    if (std::abs(s.pdf / sky.sky_pdf(s.direction) - 1) > 1e-5F) ++differ;
  }
  EXPECT_LT(differ, 20);  // rounding on the border between two cells
}

TEST(Sky, SampledIrradianceIsTheIrradiance) {
  const Sky sky(with_sun(35));
  DVec3 sum(0);
  constexpr int samples = 100000;
  for (int k = 0; k < samples; ++k) {
    const SkySample s = sky.sample_sky(random_point(k));
    sum += DVec3(s.radiance) * static_cast<double>(std::max(s.direction.z, 0.0F) / s.pdf);
  }
  DVec3 quadrature(0);
  constexpr int fine = 600;
  for (int j = 0; j < fine; ++j)
    for (int i = 0; i < fine; ++i) {
      const float z = (static_cast<float>(j) + 0.5F) / fine;
      const float a = 2 * pi * (static_cast<float>(i) + 0.5F) / fine;
      const float across = std::sqrt(1 - z * z);
      quadrature += DVec3(sky.radiance({across * std::cos(a), across * std::sin(a), z})) *
                    (static_cast<double>(z) * 2 * pi_d / (fine * fine));
    }
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(sum[c] / samples / quadrature[c], 1, 0.01);
    EXPECT_NEAR(static_cast<double>(sky.sky_irradiance()[c]) / quadrature[c], 1, 0.002);
  }
}

TEST(Sky, SunSamplesStayInTheDiscAndGiveItsIrradiance) {
  for (const float size : {0.53F, 4.0F}) {
    SkySettings settings = with_sun(42);
    settings.sun_size = size;
    const Sky sky(settings);
    DVec3 sum(0);
    constexpr int samples = 50000;
    const float limit = std::cos(radians(size / 2)) - 1e-6F;
    for (int k = 0; k < samples; ++k) {
      const SkySample s = sky.sample_sun(random_point(k));
      ASSERT_GE(glm::dot(s.direction, sky.sun_direction()), limit);
      ASSERT_GT(s.pdf, 0);
      sum += DVec3(s.radiance) / static_cast<double>(s.pdf);
    }
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(sum[c] / samples / static_cast<double>(sky.sun_irradiance()[c]), 1, 0.005);
  }
}

TEST(Sky, SizeOfTheSunDoesNotChangeItsLight) {
  SkySettings large = with_sun(42);
  large.sun_size = 3;
  EXPECT_EQ(Sky(large).sun_irradiance(), Sky(with_sun(42)).sun_irradiance());
}

TEST(Sky, LimbIsDarkerAndRedder) {
  const Sky sky(with_sun(50));
  const Vec3 centre = sky.sun_radiance(sky.sun_direction());
  const Vec3 limb = sky.sun_radiance(sky_direction(50 + 0.25, 200));
  EXPECT_LT(lum(limb), 0.7 * lum(centre));
  EXPECT_LT(limb.z / limb.x, centre.z / centre.x);
  EXPECT_EQ(sky.sun_radiance(sky_direction(50.28, 200)), Vec3(0));
  EXPECT_EQ(sky.sun_pdf(sky_direction(50.28, 200)), 0);
  EXPECT_GT(sky.sun_pdf(sky_direction(50.25, 200)), 0);
}

TEST(Sky, SunByPlaceAndTime) {
  SkySettings settings;
  settings.place = {50, 0};
  settings.time = {2026, 6, 21, 12, 2, 0, 0};
  const Vec3 d = Sky(settings).sun_direction();
  EXPECT_NEAR(degrees(std::asin(d.z)), 63.44F, 0.05F);
  EXPECT_LT(d.y, -0.4F);
}

TEST(Sky, SaysWhatIsWrongWithASun) {
  SkySettings settings;
  settings.sun = {10};
  EXPECT_THROW(Sky{settings}, Error);
  settings.sun = {100, 0};
  EXPECT_THROW(Sky{settings}, Error);
}

TEST(Sky, DescriptionNamesEveryParameterAndRefusesAWrongTurbidity) {
  SkySettings settings;
  const ParameterSet set = describe(settings);
  EXPECT_EQ(set.parameters.size(), 29U);
  set.assign(&settings, "sun", std::vector<double>{12, 90});
  EXPECT_EQ(settings.sun.size(), 2U);
  EXPECT_THROW(set.assign(&settings, "turbidity", 1.0), Error);
}

TEST(Sky, SameBitsForAnyNumberOfThreads) {
  Vec3 reference{0};
  for (const int threads : {1, 2, 4}) {
    const ThreadLimit limit(threads);
    const Sky sky(with_sun(20));
    Vec3 sum{0};
    for (int k = 0; k < 1000; ++k) sum += sky.radiance(uniform_direction(k));
    sum += sky.sky_irradiance();
    if (threads == 1) reference = sum;
    EXPECT_EQ(sum, reference);
  }
}

}  // namespace
}  // namespace wold
