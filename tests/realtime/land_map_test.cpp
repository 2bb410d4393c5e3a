#include "realtime/land_map.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "realtime/packing.hpp"

namespace wold {
namespace {

/// 64 cells of 10 m, a slope to the east.
Heightfield slope() {
  Heightfield field{Grid<float>(65, 65), DVec2(-320), 10};
  for (int j = 0; j < 65; ++j)
    for (int i = 0; i < 65; ++i) field.height(i, j) = 2.0F * static_cast<float>(i);
  return field;
}

Heightfield map_of(const Heightfield& field, float (*value)(int, int)) {
  Heightfield map{Grid<float>(65, 65), field.origin, field.cell};
  for (int j = 0; j < 65; ++j)
    for (int i = 0; i < 65; ++i) map.height(i, j) = value(i, j);
  return map;
}

TEST(LandMap, WaterLiesAtItsLevel) {
  const Heightfield field = slope();
  GroundDressing dressing;
  Grid<float> depth(65, 65);
  for (int j = 0; j < 65; ++j)
    for (int i = 0; i < 65; ++i) depth(i, j) = std::max(0.0F, 31 - field.height(i, j));
  dressing.inner_water = WaterLayer(field, depth, 0.05F);
  for (const int size : {65, 33}) {
    const LandMap map = land_map(field, dressing, {}, size);
    ASSERT_TRUE(map.water) << size;
    const int factor = 64 / (size - 1);
    for (int j = 0; j < size; ++j)
      for (int i = 0; i < size; ++i) {
        if (factor * i < 15) {
          EXPECT_NEAR(map.water_level(i, j), 31, 0.01) << i << " " << j;
        }
        if (factor * i > 20) {
          EXPECT_LT(map.water->at(i, j), 0) << i << " " << j;
        }
      }
  }
}

TEST(LandMap, WaterBelowTheGroundIsNone) {
  const Heightfield field = slope();
  GroundDressing dressing;
  dressing.inner_water = WaterLayer(field, Grid<float>(65, 65, 0.01F), 0.05F);
  EXPECT_FALSE(land_map(field, dressing, {}, 65).water);
  EXPECT_TRUE(land_map(field, {}, {}, 65).covers.empty());
  EXPECT_TRUE(land_map(field, {}, {}, 65).trees.empty());
}

TEST(LandMap, CoversLieOverOneAnother) {
  const Heightfield field = slope();
  GroundCover below;
  below.range = {1, 2};
  below.color1 = below.color2 = Vec3(0.04F, 0.16F, 0.36F);
  GroundCover above = below;
  above.color1 = above.color2 = Vec3(0.64F);
  above.opacity = 0.5F;
  GroundDressing dressing;
  const auto west = [](int i, int) { return i <= 40 ? 1.5F : -9.0F; };
  const auto south = [](int, int j) { return j <= 20 ? 1.5F : -9.0F; };
  dressing.covers.emplace_back(below, map_of(field, west), Heightfield{}, 1);
  dressing.covers.emplace_back(above, map_of(field, south), Heightfield{}, 2);
  const LandMap map = land_map(field, dressing, {}, 65);
  ASSERT_EQ(map.covers.size(), 4U * 65 * 65);
  const auto at = [&](std::size_t plane, std::size_t i, std::size_t j) {
    return static_cast<float>(map.covers[plane * 65 * 65 + 65 * j + i]) / 255;
  };
  constexpr float step = 0.004F;
  // Both, one alone, the other alone, none.
  EXPECT_NEAR(at(3, 10, 10), 1, step);
  EXPECT_NEAR(at(0, 10, 10), std::sqrt(0.5F * 0.04F + 0.5F * 0.64F), step);
  EXPECT_NEAR(at(2, 10, 10), std::sqrt(0.5F * 0.36F + 0.5F * 0.64F), step);
  EXPECT_NEAR(at(3, 10, 50), 1, step);
  EXPECT_NEAR(at(1, 10, 50), 0.4F, step);
  EXPECT_NEAR(at(3, 60, 10), 0.5F, step);
  EXPECT_NEAR(at(0, 60, 10), 0.8F, step);
  EXPECT_NEAR(at(3, 60, 50), 0, step);
}

TEST(LandMap, TreesCoverAShareByTheirDensity) {
  const Heightfield field = slope();
  Grid<float> density(65, 65, 0.0F);
  for (int j = 0; j < 65; ++j) density(30, j) = 1.15F / 49 / 2;
  const LandMap map = land_map(field, {}, density, 65);
  ASSERT_EQ(map.trees.size(), 65U * 65);
  EXPECT_NEAR(map.trees[65 * 12 + 30], 128, 1);
  EXPECT_EQ(map.trees[65 * 12 + 33], 0);
}

TEST(Packing, BytesComeBack) {
  std::vector<std::uint8_t> samples;
  for (int k = 0; k < 7 * 12; ++k) samples.push_back(static_cast<std::uint8_t>(37 * k * k));
  EXPECT_EQ(unpacked_bytes(packed(samples, 7), 7, 12), samples);
}

}  // namespace
}  // namespace wold
