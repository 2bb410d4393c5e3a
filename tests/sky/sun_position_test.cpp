#include "sky/sun_position.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace wold {
namespace {

TEST(SunPosition, AgreesWithTheExampleOfNrelSpa) {
  const DateTime time{2003, 10, 17, 12, 30, 30, -7 * 60};
  const SunPosition sun = sun_position(time, {39.742476, -105.1786, 1830.14, 820, 11});
  EXPECT_NEAR(sun.zenith, 50.111622, 0.001);
  EXPECT_NEAR(sun.azimuth, 194.340241, 0.001);
}

TEST(SunPosition, AgreesWithTheExampleOfMeeus) {
  // Example 25.b: 1992-10-13 0 h dynamical time, declination -7°47'01.74" seen from the centre of
  // the Earth. From the pole the sun stands at its declination, less the parallax of 8.79".
  const SunPosition sun = sun_position({1992, 10, 12, 23, 59, 1}, {90, 0});
  EXPECT_NEAR(sun.true_elevation, -(7 + (47 + 1.74 / 60) / 60) - 0.00242, 0.0005);
}

/// Elevation without refraction, and so without the pressure of the day.
double elevation(const DateTime& time, double latitude, double longitude) {
  return sun_position(time, {latitude, longitude}).true_elevation;
}

double highest_in_a_day(int year, int month, int day, double latitude) {
  double highest = -90;
  for (int minute = 0; minute < 1440; ++minute)
    highest = std::max(highest, elevation({year, month, day, 0, minute}, latitude, 0));
  return highest;
}

TEST(SunPosition, NoonAltitudesOfSolsticeAndEquinox) {
  constexpr double obliquity = 23.436;
  // 90° - latitude + declination; south of the sun it culminates in the north.
  EXPECT_NEAR(highest_in_a_day(2026, 6, 21, 50), 90 - 50 + obliquity, 0.01);
  EXPECT_NEAR(highest_in_a_day(2026, 12, 21, 50), 90 - 50 - obliquity, 0.01);
  EXPECT_NEAR(highest_in_a_day(2026, 12, 21, -35), 90 - 35 + obliquity, 0.01);
  // Equinox of 2026-03-20 14:46 UTC: the declination passes 0 within 3 hours of noon at 0°.
  EXPECT_NEAR(highest_in_a_day(2026, 3, 20, 50), 40, 0.06);
}

TEST(SunPosition, CulminatesInTheSouthOrTheNorth) {
  EXPECT_NEAR(sun_position({2026, 6, 21, 12, 2}, {50, 0}).azimuth, 180, 1);
  const double north = sun_position({2026, 6, 21, 12, 2}, {-35, 0}).azimuth;
  EXPECT_NEAR(std::remainder(north, 360.0), 0, 1);
}

/// Hours of universal time at which the upper limb rises (refraction 34', radius 16').
double sunrise(int month, int day, double latitude, double longitude, double from_hour) {
  for (double hour = from_hour; hour < from_hour + 12; hour += 1.0 / 120) {
    const DateTime time{2024, month, day, 0, 0, hour * 3600};
    if (elevation(time, latitude, longitude) > -50.0 / 60) return hour;
  }
  return -1;
}

TEST(SunPosition, SunriseOfAlmanacs) {
  // Greenwich, 2024-06-21: 03:43 UTC; 2024-12-21: 08:04 UTC. Sydney, 2024-01-01: 05:48 UTC+11.
  EXPECT_NEAR(sunrise(6, 21, 51.4779, 0, 0), 3 + 43.0 / 60, 1.5 / 60);
  EXPECT_NEAR(sunrise(12, 21, 51.4779, 0, 0), 8 + 4.0 / 60, 1.5 / 60);
  EXPECT_NEAR(sunrise(1, 1, -33.8688, 151.2093, 13), 24 - 11 + 5 + 48.0 / 60, 1.5 / 60);
}

TEST(SunPosition, RefractionLiftsTheSunMostAtTheHorizon) {
  // Greenwich at the equinox: look for the sun on the horizon, where air lifts it by half a degree.
  for (int minute = 300; minute < 420; ++minute) {
    const SunPosition sun = sun_position({2024, 3, 20, 0, minute}, {51.4779, 0});
    const double lift = 90 - sun.zenith - sun.true_elevation;
    if (std::abs(sun.true_elevation) < 0.1) {
      EXPECT_NEAR(lift, 0.48, 0.04);
    }
    EXPECT_GE(lift, -1e-12);
  }
  const SunPosition high = sun_position({2024, 6, 21, 12, 0}, {30, 0});
  EXPECT_LT(90 - high.zenith - high.true_elevation, 0.01);
}

TEST(SunPosition, ZoneOfTheClockDoesNotMatter) {
  const SunPosition utc = sun_position({2026, 1, 1, 0, 15, 0, 0}, {49, 16});
  const SunPosition local = sun_position({2025, 12, 31, 18, 15, 0, -360}, {49, 16});
  EXPECT_NEAR(utc.zenith, local.zenith, 1e-6);
  EXPECT_NEAR(utc.azimuth, local.azimuth, 1e-6);
}

TEST(SunPosition, FormulaOfPreethamIsWithinADegreeOfTheTruth) {
  // Day 180 of 2025 is 29 June; zone UTC+1 has its meridian at 15° east.
  for (const double hour : {6.0, 9.5, 12.0, 15.0, 18.5}) {
    const SunPosition rough = sun_position_preetham(51, 19, 15, 180, hour);
    const SunPosition fine = sun_position({2025, 6, 29, 0, 0, hour * 3600, 60}, {51, 19});
    EXPECT_NEAR(rough.true_elevation, fine.true_elevation, 0.5);
    EXPECT_NEAR(rough.azimuth, fine.azimuth, 1);
  }
  for (const double hour : {8.0, 12.0, 16.0}) {
    const SunPosition rough = sun_position_preetham(-34, 151, 150, 15, hour);
    const SunPosition fine = sun_position({2025, 1, 15, 0, 0, hour * 3600, 600}, {-34, 151});
    EXPECT_NEAR(rough.true_elevation, fine.true_elevation, 0.7);
    EXPECT_NEAR(std::remainder(rough.azimuth - fine.azimuth, 360.0), 0, 2);
  }
}

TEST(SunPosition, DirectionsOfTheCompass) {
  const auto near = [](Vec3 a, Vec3 b) { return glm::length(a - b) < 1e-6F; };
  EXPECT_TRUE(near(sky_direction(0, 0), {0, 1, 0}));
  EXPECT_TRUE(near(sky_direction(0, 90), {1, 0, 0}));
  EXPECT_TRUE(near(sky_direction(90, 33), {0, 0, 1}));
  EXPECT_TRUE(near(sky_direction(45, 180), {0, -std::sqrt(0.5F), std::sqrt(0.5F)}));
}

}  // namespace
}  // namespace wold
