#include "image/tonemap.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/hash.hpp"
#include "base/parallel.hpp"
#include "image/color.hpp"

namespace wold {
namespace {

constexpr ToneOperator all_operators[] = {ToneOperator::clip, ToneOperator::exponential,
                                          ToneOperator::agx, ToneOperator::agx_punchy,
                                          ToneOperator::neutral};

class EveryToneMap : public ::testing::TestWithParam<ToneOperator> {};
INSTANTIATE_TEST_SUITE_P(Operators, EveryToneMap, ::testing::ValuesIn(all_operators));

TEST_P(EveryToneMap, BlackStaysBlack) {
  EXPECT_EQ(tone_mapped(Vec3(0), GetParam()), Vec3(0));
}

TEST_P(EveryToneMap, GreyStaysGreyAndBrighterIsNotDarker) {
  float before = 0;
  for (float stops = -14; stops <= 12; stops += 0.05F) {
    const Vec3 shown = tone_mapped(Vec3(std::exp2(stops)), GetParam());
    EXPECT_NEAR(shown.x, shown.y, 2e-6F);
    EXPECT_NEAR(shown.x, shown.z, 2e-6F);
    EXPECT_GE(shown.y, before - 1e-6F) << stops;
    before = shown.y;
  }
  EXPECT_GT(before, 0.99F);
}

TEST_P(EveryToneMap, AnyLightIsShown) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  std::vector<Vec3> colors{Vec3(infinity), Vec3(std::nanf("")), Vec3(-1, 2, infinity)};
  for (int k = 0; k < 2000; ++k) {
    const auto part = [&](int c) { return std::exp2(30 * uniform(random_bits(1, k, c)) - 20); };
    colors.emplace_back(part(0), part(1), part(2));
  }
  for (const Vec3& color : colors) {
    const Vec3 shown = tone_mapped(color, GetParam());
    for (int c = 0; c < 3; ++c) {
      EXPECT_GE(shown[c], 0.0F);
      EXPECT_LE(shown[c], 1.0F);
    }
  }
}

TEST(ToneMap, ExponentialAndClipAreTheirFormulas) {
  EXPECT_NEAR(tone_mapped(Vec3(1), ToneOperator::exponential).x, 1 - std::exp(-1.0F), 1e-7F);
  EXPECT_EQ(tone_mapped(Vec3(0.25F, 1, 3), ToneOperator::clip), Vec3(0.25F, 1, 1));
}

TEST(ToneMap, AgxGoesThroughItsPivotAndItsPublishedFit) {
  // Middle grey is 0.5 before the gamma of 2.2.
  EXPECT_NEAR(tone_mapped(Vec3(0.18F), ToneOperator::agx).y, std::pow(0.5F, 2.2F), 1e-5F);
  // Ends of the range: 10 stops below, 6.5 above.
  EXPECT_LT(tone_mapped(Vec3(0.18F * 0x1p-10F), ToneOperator::agx).y, 1e-6F);
  EXPECT_NEAR(tone_mapped(Vec3(0.18F * std::exp2(6.5F)), ToneOperator::agx).y, 1, 1e-5F);
  // Wrensch's polynomial of sixth order was fitted to the same curve with a mean squared error of
  // 3.7e-6.
  double squares = 0;
  int count = 0;
  for (double x = 0.01; x < 1; x += 0.01, ++count) {
    const double fit =
        ((((((15.5 * x - 40.14) * x + 31.96) * x - 6.868) * x + 0.4298) * x) + 0.1191) * x -
        0.00232;
    const auto light = static_cast<float>(0.18 * std::exp2(16.5 * x - 10));
    const double curve =
        std::pow(static_cast<double>(tone_mapped(Vec3(light), ToneOperator::agx).y), 1 / 2.2);
    squares += (curve - fit) * (curve - fit);
  }
  EXPECT_LT(squares / count, 8e-6);
}

TEST(ToneMap, AgxTurnsBrightColoursTowardsWhite) {
  const Vec3 dim = tone_mapped(Vec3(0.2F, 0.02F, 0.02F), ToneOperator::agx);
  const Vec3 bright = tone_mapped(Vec3(20, 2, 2), ToneOperator::agx);
  EXPECT_GT(dim.x / dim.y, 2 * bright.x / bright.y);
  const Vec3 punchy = tone_mapped(Vec3(0.2F, 0.02F, 0.02F), ToneOperator::agx_punchy);
  EXPECT_GT(punchy.x / punchy.y, dim.x / dim.y);
}

TEST(ToneMap, NeutralHasTheValuesOfItsSpecification) {
  const auto neutral = [](Vec3 c) { return tone_mapped(c, ToneOperator::neutral); };
  // Below the compression: minus the Fresnel part, x - 6.25 x² or 0.04.
  EXPECT_NEAR(neutral(Vec3(0.5F)).x, 0.46F, 1e-6F);
  EXPECT_NEAR(neutral(Vec3(0.04F)).x, 6.25F * 0.04F * 0.04F, 1e-7F);
  const Vec3 red = neutral(Vec3(0.6F, 0.1F, 0.1F));
  EXPECT_NEAR(red.x, 0.56F, 1e-6F);
  EXPECT_NEAR(red.y, 0.06F, 1e-6F);
  // Above: 1 - 0.24² / (peak + 0.24 - 0.76).
  EXPECT_NEAR(neutral(Vec3(1.04F)).x, 1 - 0.0576F / (1 - 0.52F), 1e-6F);
}

Image grey_picture(int width, int height, float value) {
  return {width, height, {"R", "G", "B"}, value};
}

TEST(Exposure, FlatPictureBecomesMeteredGrey) {
  EXPECT_NEAR(measured_exposure(grey_picture(32, 32, metered_grey)), 0, 0.02F);
  EXPECT_NEAR(measured_exposure(grey_picture(32, 32, metered_grey * 16)), -4, 0.02F);
  EXPECT_NEAR(exposure_of(grey_picture(8, 8, metered_grey / 2), {.exposure = 1.5F}), 2.5F, 0.02F);
  EXPECT_EQ(
      exposure_of(grey_picture(8, 8, metered_grey / 2), {.exposure = 1.5F, .auto_exposure = false}),
      1.5F);
}

TEST(Exposure, BlackAndBrokenPixelsDoNotCount) {
  Image image = grey_picture(32, 32, metered_grey);
  for (int x = 0; x < 32; ++x) {
    image.at(x, 20, 0) = std::nanf("");
    for (int c = 0; c < 3; ++c) image.at(x, 25, c) = 0;
  }
  EXPECT_NEAR(measured_exposure(image), 0, 0.02F);
  EXPECT_EQ(measured_exposure(grey_picture(4, 4, 0)), 0.0F);
}

TEST(Exposure, SunAndSkyMoveItLittle) {
  Image image = grey_picture(64, 64, metered_grey);
  const float land = measured_exposure(image);
  Image glitter = image;
  for (int x = 0; x < 64; ++x)
    for (int c = 0; c < 3; ++c) glitter.at(x, 63, c) = 1e5F;  // the sun in water: below 5 percent
  EXPECT_NEAR(measured_exposure(glitter), land, 0.05F);
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 64; ++x)
      for (int c = 0; c < 3; ++c) image.at(x, y, c) = metered_grey * 8;  // a sky 3 stops brighter
  EXPECT_NEAR(measured_exposure(image), land, 1.2F);
  std::vector<float> weights(64 * 64, 1.0F);
  std::fill_n(weights.begin(), 64 * 32, 0.0F);
  EXPECT_NEAR(measured_exposure(image, weights), land, 0.02F);
}

TEST(DisplayImage, IsEncodedAndTheSameOnAnyThreads) {
  Image image(40, 30, {"R", "G", "B", "A", "Z"});
  for (std::size_t k = 0; k < image.pixels.size(); ++k)
    image.pixels[k] = 3 * uniform(random_bits(3, k));
  const ThreadLimit one(1);
  const Image display = display_image(image, {});
  EXPECT_EQ(display.channels, (std::vector<std::string>{"R", "G", "B"}));
  for (const int threads : {2, 4}) {
    const ThreadLimit limit(threads);
    EXPECT_EQ(display_image(image, {}).pixels, display.pixels);
  }
  const ToneMapping plain{ToneOperator::clip, 1, false};
  const Image grey = display_image(grey_picture(2, 2, 0.1F), plain);
  EXPECT_NEAR(grey.at(0, 0, 0), linear_to_srgb(0.2F), 1e-6F);
}

TEST(DisplayImage, ParametersAreDescribed) {
  const ParameterSet set = describe(ToneMapping{});
  EXPECT_EQ(set.names(), (std::vector<std::string>{"tone_map", "exposure", "auto_exposure"}));
  ToneMapping mapping;
  set.assign(&mapping, "tone_map", std::string("neutral"));
  EXPECT_EQ(mapping.tone_map, ToneOperator::neutral);
}

}  // namespace
}  // namespace wold
