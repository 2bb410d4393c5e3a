#include "scene/planted_world.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "scene/build.hpp"
#include "scene/same_scene.hpp"

namespace wold {
namespace {

Scene small_scene(const std::string& more = "") {
  return parse_scene(R"(
seed = 5
[terrain]
size = 400
resolution = 65
[surroundings]
resolution = 33
[[terrain.step]]
op = "fbm"
height = 40
feature_size = 200
[[species]]
name = "fern"
plant = "plants/fern.lsys"
height = [0.4, 0.8]
[[scatter]]
species = { fern = 1 }
density = 0.01
[[camera]]
position = [10, -20]
look_direction = [0, 1, 0]
[render]
size = [32, 18]
)" + more,
                     "small.toml", WOLD_SOURCE_DIR);
}

TEST(PlantedWorld, SetsPlantsOnTheGroundWithItsDetail) {
  Progress progress;
  const PlantedWorld world(small_scene(), progress);
  std::vector<ModelInstance> plants = world.world().instances;
  ASSERT_GT(plants.size(), 100U);
  world.set_on_detailed_ground(plants, 0.1F);
  int moved = 0;
  for (std::size_t k = 0; k < plants.size(); ++k) {
    const ModelInstance& before = world.world().instances[k];
    const DVec2 place(before.position.x, before.position.y);
    const Ground& ground = world.world().ground;
    const float rise = ground.detailed(place, 0.1F).height - ground.base(place).height;
    EXPECT_NEAR(plants[k].position.z, before.position.z + rise, 1e-4F);
    moved += std::abs(rise) > 0.01F ? 1 : 0;
  }
  EXPECT_GT(moved, 50);
}

TEST(SameScene, TellsLandModelsAndSkyApart) {
  const Scene a = small_scene();
  EXPECT_TRUE(same_land(a, small_scene()));
  EXPECT_TRUE(same_models(a, small_scene()));
  EXPECT_TRUE(same_sky(a, small_scene()));
  Scene b = small_scene();
  b.steps[0].parameters.assign("height", 41.0);
  EXPECT_FALSE(same_land(a, b));
  EXPECT_TRUE(same_models(a, b));
  b = small_scene();
  b.steps[0].settings.opacity = 0.5F;
  EXPECT_FALSE(same_land(a, b));
  b = small_scene();
  b.species[0].models = 2;
  EXPECT_TRUE(same_land(a, b));
  EXPECT_FALSE(same_models(a, b));
  b = small_scene();
  b.header.seed = 6;
  EXPECT_FALSE(same_land(a, b));
  EXPECT_FALSE(same_models(a, b));
  b = small_scene();
  b.sky.time.hour = 3;
  EXPECT_FALSE(same_sky(a, b));
  EXPECT_TRUE(same_land(a, b));
}

TEST(PlantedWorld, TakesWhatIsTheSameFromTheOneBefore) {
  Progress progress;
  const PlantedWorld first(small_scene(), progress);
  Scene more = small_scene();
  more.scatter[0].density = 0.05F;
  const PlantedWorld second(more, progress, &first);
  const PlantedWorld fresh(more, progress);
  EXPECT_EQ(second.world().ground.field().height.values().size(), 65U * 65U);
  EXPECT_TRUE(std::ranges::equal(second.world().ground.field().height.values(),
                                 fresh.world().ground.field().height.values()));
  ASSERT_EQ(second.world().instances.size(), fresh.world().instances.size());
  EXPECT_GT(second.world().instances.size(), first.world().instances.size());
  for (std::size_t k = 0; k < fresh.world().instances.size(); ++k)
    ASSERT_EQ(second.world().instances[k].position, fresh.world().instances[k].position);
}

TEST(PlantedWorld, TracesWhatBuildTraces) {
  Progress progress;
  const Scene scene = small_scene();
  PlantedWorld planted(scene, progress);
  const Camera camera = planted.camera(scene.camera(""), progress);
  const TracedWorld traced = planted.traced(camera, scene.render.size, progress);
  const BuiltScene built = build(scene, "", progress);
  EXPECT_EQ(camera.position, built.camera.position);
  ASSERT_EQ(traced.world->instances.size(), built.world->instances.size());
  for (std::size_t k = 0; k < built.world->instances.size(); ++k)
    ASSERT_EQ(traced.world->instances[k].position, built.world->instances[k].position);
  EXPECT_EQ(traced.rays->unique_triangles(), built.rays->unique_triangles());
}

}  // namespace
}  // namespace wold
