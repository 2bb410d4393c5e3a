#include "scene/dressing.hpp"

#include <gtest/gtest.h>

namespace wold {
namespace {

TerrainResult land(DVec2 origin, double size, int samples, float height) {
  TerrainResult result;
  result.field = {Grid<float>(samples, samples, height), origin, size / (samples - 1)};
  return result;
}

Scene flooded() {
  return parse_scene(
      "[terrain]\nsize = 1000\nresolution = 65\n[[terrain.step]]\nname = \"flood\"\n"
      "op = \"pipes\"\n[water]\ndepth = \"flood.water\"\n",
      "test.toml", {});
}

/// Surroundings of four times the terrain's size whose level ground lies at 0, with still water 30
/// m deep.
TerrainResult drowned() {
  TerrainResult around = land(DVec2(-2000), 4000, 129, 0);
  around.maps["flood.water"] = Grid<float>(129, 129, 30.0F);
  return around;
}

TEST(Dressing, StillWaterThatWouldStandAslantIsLeftOut) {
  const Scene scene = flooded();
  Progress progress;
  TerrainResult terrain = land(DVec2(-500), 1000, 65, -100);
  terrain.maps["flood.water"] = Grid<float>(65, 65, 0.0F);
  const GroundDressing bent = dress_ground(scene, terrain, drowned(), progress);
  EXPECT_LT(bent.outer_water.level_at({700, 0}), 0.0F);          // bent down by 100 m over 500 m
  EXPECT_NEAR(*bent.outer_water.level_at({1500, 0}), 30, 0.1F);  // not bent any more

  terrain.field.height = Grid<float>(65, 65, 0.0F);
  const GroundDressing level = dress_ground(scene, terrain, drowned(), progress);
  EXPECT_NEAR(*level.outer_water.level_at({700, 0}), 30, 0.1F);
}

TEST(Dressing, RiversFollowGroundThatIsBent) {
  const Scene scene = flooded();
  Progress progress;
  TerrainResult terrain = land(DVec2(-500), 1000, 65, -100);
  terrain.maps["flood.water"] = Grid<float>(65, 65, 0.0F);
  TerrainResult around = drowned();
  const auto rise = [](DVec2 place) { return 0.2F * static_cast<float>(place.y + 2000); };
  const auto tilt = [&](Heightfield& field, float over) {
    for (int j = 0; j < field.height.height(); ++j)
      for (int i = 0; i < field.height.width(); ++i)
        field.height(i, j) = rise(field.origin + field.cell * DVec2(i, j)) + over;
  };
  tilt(around.field, 0);
  tilt(terrain.field, -100);
  around.maps["flood.water"] = Grid<float>(129, 129, 1.0F);
  const GroundDressing bent = dress_ground(scene, terrain, around, progress);
  EXPECT_NEAR(*bent.outer_water.level_at({700, 0}), rise({700, 0}) + 1, 0.1F);
}

TEST(Dressing, TreesStandAsDenselyAsScattersAskFor) {
  const Scene scene = parse_scene(
      "[terrain]\nsize = 1000\nresolution = 65\n"
      "[[species]]\nname = \"oak\"\nplant = \"plants/oak.lsys\"\nheight = [8, 20]\n"
      "[[species]]\nname = \"fern\"\nplant = \"plants/fern.lsys\"\nheight = [0.5, 1]\n"
      "[[scatter]]\nspecies = { oak = 1, fern = 3 }\ndensity = 0.04\nslope = [0, 20]\n"
      "within = 100\n[[scatter]]\nspecies = { oak = 1 }\ndensity = 0.01\n"
      "[[scatter]]\nspecies = { fern = 1 }\ndensity = 5\n",
      "test.toml", {});
  EXPECT_TRUE(plants_trees(scene, scene.scatter[0]));
  EXPECT_FALSE(plants_trees(scene, scene.scatter[2]));
  // Level in the west, 45° in the east.
  Heightfield field{Grid<float>(65, 65), DVec2(-500), 1000.0 / 64};
  for (int j = 0; j < 65; ++j)
    for (int i = 32; i < 65; ++i) field.height(i, j) = static_cast<float>(field.cell * (i - 32));
  Progress progress;
  const Grid<float> density = tree_density(scene, field, {}, progress);
  EXPECT_NEAR(density(10, 30), 0.01F + 0.01F, 1e-5F);
  EXPECT_NEAR(density(60, 30), 0, 1e-5F);

  Scene bare = scene;
  bare.scatter.erase(bare.scatter.begin(), bare.scatter.begin() + 2);
  EXPECT_TRUE(tree_density(bare, field, {}, progress).empty());
}

}  // namespace
}  // namespace wold
