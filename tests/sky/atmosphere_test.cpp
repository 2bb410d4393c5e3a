#include "sky/atmosphere.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <initializer_list>

#include "base/hash.hpp"
#include "sky/spectrum.hpp"
#include "sky/sunlit_air.hpp"

namespace wold {
namespace {

constexpr Vec3 sunlight{1, 1, 1};

/// Air without aerosol or ozone.
Atmosphere only_molecules() {
  Atmosphere a;
  a.aerosol_scattering = Vec3(0);
  a.ozone = 0;
  return a;
}

Atmosphere hazy() {
  Atmosphere a;
  a.aerosol_scattering = Vec3(4e-5F);
  return a;
}

double luminance_of(Vec3 c) {
  return luminance(DVec3(c));
}

AirLight sky_once(const Atmosphere& a, double elevation, double sun_elevation, double turn,
                  float height = 0, int steps = 64, int light_steps = 32) {
  const double e = radians(elevation);
  const double s = radians(sun_elevation);
  const double to_sun =
      std::sin(e) * std::sin(s) + std::cos(e) * std::cos(s) * std::cos(radians(turn));
  const AirRay ray{height, static_cast<float>(std::sin(e)), static_cast<float>(std::sin(s)),
                   static_cast<float>(to_sun)};
  return single_scattering(a, ray, INFINITY, sunlight, steps, light_steps);
}

TEST(Atmosphere, VerticalOpticalDepthIsTheClosedForm) {
  const Atmosphere a = only_molecules();
  const AirColumn column = air_column(a, 0, 1, 0, a.air_thickness, 40);
  EXPECT_NEAR(column.x / (8000 * (1 - std::exp(-100.0F / 8))), 1, 1e-4);
  EXPECT_NEAR(column.y / (1200 * (1 - std::exp(-100.0F / 1.2F))), 1, 1e-4);
  EXPECT_NEAR(column.z / 15000, 1, 0.01);  // the tent's area
  const Vec3 t = transmittance(a, 0, 1, INFINITY, 40);
  const float depth = 8000 * (1 - std::exp(-100.0F / 8));
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(t[c], std::exp(-air_scattering(a.air)[c] * depth), 1e-5F);
}

TEST(Atmosphere, PathsOfEveryAngleMatchQuadratureInDouble) {
  const Atmosphere a;
  for (const double cosine : {1.0, 0.5, 0.2, 0.05, 0.0}) {
    const double r = a.planet_radius;
    const double top = r + static_cast<double>(a.air_thickness);
    const double length = -r * cosine + std::sqrt(r * r * cosine * cosine + top * top - r * r);
    DVec2 exact(0);
    constexpr int n = 200000;
    for (int k = 0; k < n; ++k) {
      const double s = length * (k + 0.5) / n;
      const double h = std::sqrt(r * r + 2 * r * s * cosine + s * s) - r;
      exact += DVec2(std::exp(-h / 8000), std::exp(-h / 1200)) * (length / n);
    }
    const auto mu = static_cast<float>(cosine);
    const AirColumn column = air_column(a, 0, mu, 0, distance_to_space(a, 0, mu), 128);
    EXPECT_NEAR(static_cast<double>(column.x) / exact.x, 1, 1e-3) << cosine;
    EXPECT_NEAR(static_cast<double>(column.y) / exact.y, 1, 2e-3) << cosine;
    // Chapman: over the horizontal √(π R H / 2) (1 + 3H/8R).
    if (cosine == 0) {
      EXPECT_NEAR(exact.x / std::sqrt(pi_d * r * 8000 / 2), 1, 2e-3);
      EXPECT_NEAR(exact.x / 8000, 35.3, 0.3);
    }
  }
}

TEST(Atmosphere, TransmittanceOfPartsMultipliesAndGoesBothWays) {
  const Atmosphere a = hazy();
  for (const float cosine : {0.7F, 0.1F, -0.05F}) {
    const float height = 2500;
    const float first = 12000;
    const float second = 25000;
    const AirRay there{height_after(a, height, cosine, first),
                       sun_cosine_after(a, {height, cosine, cosine, 1}, first), 1, 1};
    const AirRay end{height_after(a, height, cosine, first + second),
                     sun_cosine_after(a, {height, cosine, cosine, 1}, first + second), 1, 1};
    const Vec3 whole = transmittance(a, height, cosine, first + second, 200);
    const Vec3 parts = transmittance(a, height, cosine, first, 200) *
                       transmittance(a, there.height, there.cosine, second, 200);
    const Vec3 back = transmittance(a, end.height, -end.cosine, first + second, 200);
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(parts[c] / whole[c], 1, 1e-3) << cosine;
      EXPECT_NEAR(back[c] / whole[c], 1, 1e-3) << cosine;
    }
  }
}

TEST(Atmosphere, CoefficientsAreWhatTheirNamesSay) {
  const DVec3 nm = wavelengths(AirCoefficients::penndorf);
  for (int c = 0; c < 3; ++c) {
    const double law = rayleigh_scattering(nm[c]);
    const double popular = air_scattering(AirCoefficients::popular)[c];
    EXPECT_NEAR(static_cast<double>(air_scattering(AirCoefficients::penndorf)[c]) / law, 1, 2e-3);
    EXPECT_GT(popular / law, 1.13);
    EXPECT_LT(popular / law, 1.19);
  }
  // Colours: σ_c = C_c(E σ) / C_c(E), here under a black body of 5800 K.
  const auto colour = [](const std::function<double(double)>& factor) {
    DVec3 xyz(0);
    for (double l = 380; l <= 750; l += 1)
      xyz += cie_observer(l) * (factor(l) / (std::pow(l, 5) * std::expm1(1.43878e7 / (l * 5800))));
    return rec709_from_xyz(xyz);
  };
  const DVec3 white = colour([](double) { return 1; });
  const DVec3 rayleigh = colour(rayleigh_scattering) / white;
  const DVec3 aerosol = colour([](double l) { return std::pow(l / 550, -1.3); }) / white;
  for (int c = 0; c < 3; ++c) {
    const double expected = air_scattering(AirCoefficients::rec709)[c];
    EXPECT_NEAR(rayleigh[c] / expected, 1, 0.03) << c;
    EXPECT_NEAR(aerosol[c] / std::pow(wavelengths(AirCoefficients::rec709)[c] / 550, -1.3), 1,
                0.02);
  }
}

TEST(Atmosphere, RaysMeetTheGroundAndTheEdgeOfTheAir) {
  const Atmosphere a;
  EXPECT_NEAR(span_in_air(a, 0, 1).end, 1e5F, 10);
  const AirSpan down = span_in_air(a, 3000, -1);
  EXPECT_TRUE(down.ground);
  EXPECT_NEAR(down.end, 3000, 1);
  const AirSpan from_space = span_in_air(a, 400000, -1);
  EXPECT_NEAR(from_space.begin, 300000, 10);
  EXPECT_NEAR(from_space.end, 400000, 10);
  EXPECT_EQ(span_in_air(a, 400000, 0.5F).end, 0);
  EXPECT_FALSE(span_in_air(a, 3000, -0.02F).ground);  // above the dip of the horizon, 1.76°
  EXPECT_TRUE(span_in_air(a, 3000, -0.04F).ground);
  EXPECT_NEAR(height_after(a, 0, 0, 10000), 10000.0F * 10000 / (2 * a.planet_radius), 0.01F);
}

TEST(Atmosphere, NothingScattersWithoutCoefficientsOrSun) {
  Atmosphere none = only_molecules();
  const AirLight dark = sky_once(hazy(), 30, -60, 50);
  EXPECT_EQ(dark.light, Vec3(0));
  none.air_height = 1e-3F;
  const AirLight clear = sky_once(none, 30, 40, 50, 100);
  EXPECT_LT(luminance_of(clear.light), 1e-6);
  EXPECT_EQ(clear.transmittance, Vec3(1));
}

TEST(Atmosphere, ThinAirScattersByTheProductOfDepthAndPhase) {
  Atmosphere a = only_molecules();
  a.air_height = 80;  // 1/100 of the air
  const AirLight light = sky_once(a, 90, 90, 0);
  const Vec3 depth = air_scattering(a.air) * 80.0F;
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(light.light[c] / (depth[c] * 3 / (8 * pi)), 1, 0.005);
}

TEST(Atmosphere, ConvergesInStepsOfBothKinds) {
  for (const double sun : {50.0, 5.0})
    for (const double elevation : {80.0, 20.0, 2.0}) {
      const double exact = luminance_of(sky_once(hazy(), elevation, sun, 60, 0, 512, 256).light);
      const auto error = [&](int steps, int light_steps) {
        const AirLight light = sky_once(hazy(), elevation, sun, 60, 0, steps, light_steps);
        return std::abs(luminance_of(light.light) / exact - 1);
      };
      EXPECT_LT(error(32, 16), 0.02) << elevation << " " << sun;
      EXPECT_LT(error(64, 64), 0.006) << elevation << " " << sun;
      EXPECT_LT(error(12, 6), 0.1) << elevation << " " << sun;
    }
}

TEST(Atmosphere, ZenithIsBlueAndTheLowSunRed) {
  const Atmosphere a;
  const Vec3 zenith = sky_once(a, 90, 60, 0).light;
  EXPECT_GT(zenith.z, 2 * zenith.x);
  const Vec3 horizon = sky_once(a, 1, 60, 180).light;
  EXPECT_GT(luminance_of(horizon), 1.5 * luminance_of(zenith));
  EXPECT_LT(horizon.z / horizon.x, zenith.z / zenith.x);
  const Vec3 sunset = sky_once(a, 1, 0.5, 0).light;
  EXPECT_GT(sunset.x, 2 * sunset.z);
  const Vec3 low_sun = sun_transmittance(a, 0, std::sin(radians(2.0F)), 128);
  EXPECT_GT(low_sun.x, 3 * low_sun.z);
}

TEST(Atmosphere, ThePlanetShadowsTheAirAfterSunset) {
  const Atmosphere a = hazy();
  EXPECT_EQ(sun_above_edge(a, 0, 0.02F), 1);
  EXPECT_FLOAT_EQ(sun_above_edge(a, 0, 0), 0.5F);
  EXPECT_EQ(sun_above_edge(a, 0, -0.02F), 0);
  EXPECT_EQ(sun_above_edge(a, 20000, -0.02F), 1);  // the edge lies 4.5° down
  EXPECT_EQ(sun_transmittance(a, 0, -0.05F, 32), Vec3(0));
  EXPECT_GT(sun_transmittance(a, 20000, -0.05F, 32).x, 0);
  // The sun 6° down: the side opposite to it is darker than its own; at 20° all is dark.
  const double sunward = luminance_of(sky_once(a, 10, -6, 0).light);
  EXPECT_GT(sunward, 20 * luminance_of(sky_once(a, 10, -6, 180).light));
  EXPECT_LT(luminance_of(sky_once(a, 10, -20, 0).light), 1e-4 * sunward);
}

TEST(SunlitAir, TablesAreTheIntegrals) {
  const SunlitAir air(hazy());
  for (const float height : {0.0F, 500.0F, 3000.0F, 20000.0F, 60000.0F})
    for (const float cosine : {1.0F, 0.5F, 0.2F, 0.05F, 0.01F, 0.0F}) {
      const Vec3 exact = sun_transmittance(air.atmosphere(), height, cosine, 256);
      const Vec3 table = air.light(height, cosine).sun;
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(table[c], exact[c], 0.005F) << height << " " << cosine;
    }
}

/// Air that absorbs nothing over black ground: what the sun brings in leaves above or ends below.
/// One scattering and the second alone would lose 5 % of the blue.
TEST(SunlitAir, EnergyLeavesAsItCame) {
  Atmosphere a = only_molecules();
  a.air = AirCoefficients::popular;
  a.ground_albedo = Vec3(0);
  const SunlitAir air(a);
  for (const float sun_cosine : {0.9F, 0.5F}) {
    const auto flux = [&](float height, float sign) {
      Vec3 sum(0);
      constexpr int n = 24;
      for (int k = 0; k < n * n; ++k) {
        const float c = sign * std::sqrt((static_cast<float>(k % n) + 0.5F) / n);
        const float turn = pi * (static_cast<float>(k / n) + 0.5F) / n;  // NOLINT
        const float to_sun =
            c * sun_cosine +
            std::sqrt((1 - c * c) * (1 - sun_cosine * sun_cosine)) * std::cos(turn);
        const AirRay ray{height, c, sun_cosine, to_sun};
        sum += with_phases(a, air.seen(ray, INFINITY, 48), to_sun, sunlight).light;
      }
      return sum * (pi / (n * n));
    };
    const Vec3 out = flux(a.air_thickness * 0.999F, -1) + flux(0, 1);
    const Vec3 direct = air.light(0, sun_cosine).sun * sun_cosine;
    for (int c = 0; c < 3; ++c) {
      const float total = (out[c] + direct[c]) / sun_cosine;
      EXPECT_LT(total, 1.005F) << c;
      EXPECT_GT(total, 0.983F) << c;
    }
  }
}

TEST(SunlitAir, MoreScatteringBrightensMostWhatIsThickest) {
  const SunlitAir air(hazy());
  const Vec3 low = air.light(0, 0.7F).multiple;
  EXPECT_GT(low.z, low.x);
  EXPECT_GT(low.x, air.light(60000, 0.7F).multiple.x);
  EXPECT_GT(low.x, 10 * air.light(0, -0.05F).multiple.x);
  Atmosphere snow = hazy();
  snow.ground_albedo = Vec3(0.9F);
  EXPECT_GT(SunlitAir(snow).light(0, 0.7F).multiple.y, 1.2F * low.y);
}

}  // namespace
}  // namespace wold
