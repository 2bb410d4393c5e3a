#include "render/cover.hpp"

#include <gtest/gtest.h>

#include "render/ground.hpp"
#include "render/water.hpp"
#include "testing.hpp"

namespace wold {
namespace {

/// Values that rise from 0 in the west to `high` in the east of a square of 160 m.
Heightfield ramp(float high) {
  Heightfield map = testing::flat(160);
  for (int j = 0; j < 17; ++j)
    for (int i = 0; i < 17; ++i) map.height(i, j) = high * static_cast<float>(i) / 16;
  return map;
}

DVec2 east(double x) {
  return {x, 3};
}

TEST(Cover, LiesWhereItsMapIsInRange) {
  GroundCover settings;
  settings.range = {4, 6};
  settings.feather = 1;
  const CoverLayer layer(settings, ramp(8), {}, 1);  // 5 cm per metre: 4 at x = 0
  EXPECT_EQ(layer.share(east(20), 0), 1);            // 5
  EXPECT_EQ(layer.share(east(-40), 0), 0);           // 2
  EXPECT_EQ(layer.share(east(70), 0), 0);            // 7.5
  EXPECT_NEAR(layer.share(east(-10), 0), 0.5, 1e-4);
  EXPECT_NEAR(layer.share(east(50), 0), 0.5, 1e-4);
  EXPECT_EQ(layer.share(east(200), 0), 0);  // outside the map
}

TEST(Cover, NoiseMovesItsEdge) {
  GroundCover settings;
  settings.range = {4, 100};
  settings.feather = 1;
  settings.edge_noise = 0.5F;
  const CoverLayer layer(settings, ramp(8), {}, 1);
  EXPECT_EQ(layer.share(east(0), 0), 1);
  EXPECT_LT(layer.share(east(0), -1), 1);
  EXPECT_GT(layer.share(east(-20), 1), layer.share(east(-20), 0));
}

TEST(Cover, ColoursTheGround) {
  GroundCover settings;
  settings.range = {4, 100};
  settings.feather = 0.01F;
  settings.edge_noise = 0;
  settings.color1 = settings.color2 = Vec3(0.7F, 0.1F, 0.2F);
  settings.over_snow = true;
  settings.roughness = 0.2F;
  GroundDressing dressing;
  dressing.covers.emplace_back(settings, ramp(8), Heightfield{}, 1);
  const Ground ground(testing::flat(160), {}, testing::plain(Vec3(0.4F)), 1, std::move(dressing));
  const GroundSurface covered = ground.surface(east(40), 0.1F);
  EXPECT_NEAR(covered.reflectance.x, 0.7F, 1e-5F);
  EXPECT_EQ(covered.roughness, 0.2F);
  const GroundSurface bare = ground.surface(east(-40), 0.1F);
  EXPECT_NEAR(bare.reflectance.x, 0.4F, 1e-5F);
  EXPECT_EQ(bare.roughness, 0);
}

/// A valley along the y axis, 1 m deeper per metre towards x = 0, with water up to z = 30.
struct Valley {
  Valley() : bed(testing::flat(160)), depth(17, 17) {
    for (int j = 0; j < 17; ++j)
      for (int i = 0; i < 17; ++i) {
        bed.height(i, j) = static_cast<float>(std::abs(10.0 * i - 80));
        depth(i, j) = std::max(0.0F, 30 - bed.height(i, j));
      }
  }
  Heightfield bed;
  Grid<float> depth;
};

TEST(Water, ShoreLiesWhereTheGroundComesOut) {
  const Valley valley;
  const WaterLayer water(valley.bed, valley.depth, 0.05F);
  // The last wet samples are at ±20 m; the shore is at ±30 m.
  for (const double x : {-29.9, -25.0, 0.0, 12.0, 29.9}) {
    ASSERT_TRUE(water.level_at(east(x)).has_value()) << x;
    EXPECT_NEAR(*water.level_at(east(x)), 30, 0.03) << x;
  }
}

TEST(Water, GroundThatIsLowerAndDryStaysDry) {
  // A lake at 50 m above a slope that falls away to the east.
  Heightfield bed = testing::flat(160);
  Grid<float> depth(17, 17);
  for (int j = 0; j < 17; ++j)
    for (int i = 0; i < 17; ++i) {
      bed.height(i, j) = i < 8 ? 48.0F : 50.0F - 8 * static_cast<float>(i - 8);
      depth(i, j) = i < 8 ? 2.0F : 0.0F;
    }
  GroundDressing dressing;
  dressing.inner_water = WaterLayer(bed, depth, 0.05F);
  const Ground ground(bed, {}, testing::plain(Vec3(0.4F)), 1, std::move(dressing));
  EXPECT_NEAR(ground.water_depth(east(-50)), 2, 1e-3);
  EXPECT_EQ(ground.water_depth(east(25)), 0);
  EXPECT_EQ(ground.water_depth(east(60)), 0);
}

TEST(Water, IsLevelClearAtTheShoreAndDarkInTheMiddle) {
  const Valley valley;
  GroundDressing dressing;
  dressing.water.color = Vec3(0.01F);
  dressing.water.clarity = 2;
  dressing.water.ripples = 0;
  dressing.inner_water = WaterLayer(valley.bed, valley.depth, 0.05F);
  const Ground ground(valley.bed, {}, testing::plain(Vec3(0.5F)), 1, std::move(dressing));
  EXPECT_EQ(ground.detailed(east(10), 1).height, 30);
  EXPECT_EQ(ground.detailed(east(10), 1).gradient, Vec2(0));
  EXPECT_GT(ground.detailed(east(50), 1).height, 40);
  const GroundSurface deep = ground.surface(east(5), 0.1F);
  EXPECT_NEAR(deep.reflectance.x, 0.01F, 1e-3F);
  EXPECT_GT(deep.roughness, 0);
  EXPECT_EQ(deep.normal, Vec3(0, 0, 1));
  const float depth = ground.water_depth(east(28));
  const float shown = std::exp(-depth / 2);
  EXPECT_NEAR(ground.surface(east(28), 0.1F).reflectance.x, 0.01F + 0.49F * shown, 0.02F);
  EXPECT_EQ(ground.surface(east(50), 0.1F).roughness, 0);
}

}  // namespace
}  // namespace wold
