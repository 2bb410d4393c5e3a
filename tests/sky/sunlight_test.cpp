#include "sky/sunlight.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sky/spectrum.hpp"

namespace wold {
namespace {

constexpr double disc_solid_angle = 6.72e-5;  // sr, of 0.53° across

TEST(Spectrum, WhiteOfEqualEnergyAndOfD65) {
  DVec3 sum(0);
  for (int nm = 360; nm <= 830; ++nm) sum += cie_observer(nm);
  EXPECT_NEAR(sum.y, 106.857, 1);
  EXPECT_NEAR(sum.x, sum.y, 1);
  EXPECT_NEAR(sum.z, sum.y, 1);
  const DVec3 white = rec709_from_xyz(xyz_from_chromaticity(0.3127, 0.3290, 1));
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(white[k], 1, 0.002);
  EXPECT_NEAR(luminance(white), 1, 1e-4);
}

TEST(Spectrum, GamutKeepsLuminance) {
  const DVec3 orange(2, 0.4, -0.3);
  const DVec3 held = in_gamut(orange);
  EXPECT_NEAR(luminance(held), luminance(orange), 1e-12);
  EXPECT_NEAR(held.z, 0, 1e-12);
  EXPECT_EQ(in_gamut({0.2, 0.3, 0.4}), DVec3(0.2, 0.3, 0.4));
  EXPECT_EQ(in_gamut({-1, -1, 0}), DVec3(0));
}

TEST(Sunlight, AboveTheAirItIsTheSolarConstantOfLight) {
  // 128 klx at the mean distance by the table of Thekaekara, 133 klx by newer ones.
  EXPECT_NEAR(luminance(sun_disc_radiance(0, 0)) * disc_solid_angle, 131e3, 6e3);
}

TEST(Sunlight, ClearNoonIsAboutAHundredKilolux) {
  const double lux = luminance(sun_disc_radiance(25, 2.5)) * disc_solid_angle;
  EXPECT_GT(lux, 85e3);
  EXPECT_LT(lux, 115e3);
}

TEST(Sunlight, CleanAirScattersBlueByRayleighsLaw) {
  // Turbidity 1 is air without aerosol. The channels of Rec. 709 have their weight near 612, 549
  // and 464 nm, where ozone takes 4, 3 and 0.3 %.
  const DVec3 passed = sun_disc_radiance(0, 1) / sun_disc_radiance(0, 0);
  EXPECT_NEAR(passed.z, std::exp(-0.008735 * std::pow(0.464, -4.08)) * 0.997, 0.035);
  EXPECT_NEAR(passed.x, std::exp(-0.008735 * std::pow(0.612, -4.08)) * 0.96, 0.02);
}

TEST(Sunlight, ReddensAndDimsAsItSinks) {
  DVec3 before = sun_disc_radiance(0, 3);
  for (double zenith = 10; zenith <= 90; zenith += 10) {
    const DVec3 now = sun_disc_radiance(zenith, 3);
    EXPECT_LT(luminance(now), luminance(before));
    EXPECT_LT(now.z / now.x, before.z / before.x + 1e-12);
    EXPECT_GE(now.z, 0);
    before = now;
  }
  EXPECT_EQ(sun_disc_radiance(100, 3), sun_disc_radiance(90, 3));
  EXPECT_LT(luminance(sun_disc_radiance(45, 6)), luminance(sun_disc_radiance(45, 2)));
}

}  // namespace
}  // namespace wold
