#include "render/ray_scene.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <chrono>
#include <cmath>
#include <limits>

#include "base/hash.hpp"
#include "testing.hpp"

namespace wold {
namespace {

using testing::Stage;

World flat_world() {
  return {Ground(testing::flat(2000), {}, testing::plain(Vec3(0.5F)), 1),
          {},
          {},
          {},
          Sky(testing::sky(1, 1))};
}

float random(int k, int which) {
  return uniform(random_bits(11, k, which));
}

TEST(InstanceMatrix, TurnsAndScalesEvenly) {
  for (int k = 0; k < 300; ++k) {
    ModelInstance i;
    i.up = glm::normalize(Vec3(random(k, 0), random(k, 1), random(k, 2)) - Vec3(0.5F));
    if (k == 0) i.up = {1, 0, 0};
    if (k == 1) i.up = {0, 0, -1};
    i.yaw = 2 * pi * random(k, 3);
    i.scale = 0.2F + 3 * random(k, 4);
    const Mat3 m = instance_matrix(i) / i.scale;
    const Mat3 square = glm::transpose(m) * m;
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(square[c][r], r == c ? 1 : 0, 1e-5F);
    EXPECT_NEAR(glm::determinant(m), 1, 1e-5F);
    EXPECT_LT(glm::distance(m[2], i.up), 1e-6F);
  }
}

TEST(InstanceMatrix, YawTurnsAboutUp) {
  ModelInstance i;
  i.yaw = radians(90.0F);
  const Vec3 turned = instance_matrix(i) * Vec3(1, 0, 0);
  EXPECT_LT(glm::distance(turned, Vec3(0, 1, 0)), 1e-6F);
}

/// An upright square 2 m wide in the model, turned by 90° and twice as large at (50, 20, 5): its
/// plane is x = 50.
Stage wall_stage() {
  World world = flat_world();
  world.materials.emplace_back(testing::sheet(Vec3(0.5F), Vec3(0)));
  world.models.push_back({testing::square(1), {0}});
  world.models.push_back({testing::square(2, true), {0}});
  ModelInstance wall;
  wall.position = {50, 20, 5};
  wall.yaw = radians(90.0F);
  wall.scale = 2;
  wall.model = 1;
  world.instances = {ModelInstance{}, wall};
  world.instances[0].position = {-400, 0, 1};
  return Stage(std::move(world));
}

TEST(RayScene, HitsAnInstanceWhereItStands) {
  const Stage stage = wall_stage();
  RayCount count;
  const Hit hit = stage.rays->intersect({{40, 21, 5.5F}, {1, 0, 0}}, 0, false, count);
  ASSERT_TRUE(hit.valid());
  EXPECT_EQ(hit.instance, 1U);
  EXPECT_NEAR(hit.distance, 10, 1e-4F);
  EXPECT_LT(glm::distance(hit.position, Vec3(50, 21, 5.5F)), 1e-3F);
  EXPECT_NEAR(std::abs(hit.normal.x), 1, 1e-5F);
  EXPECT_LT(hit.triangle, 2U);
  // 2 m in the model is 4 m in the world.
  EXPECT_TRUE(stage.rays->intersect({{40, 21.9F, 5}, {1, 0, 0}}, 0, false, count).valid());
  EXPECT_FALSE(stage.rays->intersect({{40, 22.1F, 5}, {1, 0, 0}}, 0, false, count).valid());
  EXPECT_EQ(count.rays, 3U);
}

TEST(RayScene, BarycentricsGiveTheHitBack) {
  const Stage stage = wall_stage();
  RayCount count;
  for (int k = 0; k < 50; ++k) {
    const Vec3 aim(50, 18.1F + 3.8F * random(k, 0), 3.1F + 3.8F * random(k, 1));
    const Vec3 eye = aim - Vec3(7, 3, 1);
    const Hit hit = stage.rays->intersect({eye, glm::normalize(aim - eye)}, 0, false, count);
    ASSERT_EQ(hit.instance, 1U);
    const TriangleMesh& mesh = stage.world.models[1].mesh;
    const UVec3 t = mesh.triangles[hit.triangle];
    const Vec3 local = (1 - hit.u - hit.v) * mesh.positions[t.x] + hit.u * mesh.positions[t.y] +
                       hit.v * mesh.positions[t.z];
    const ModelInstance& i = stage.world.instances[1];
    EXPECT_LT(glm::distance(instance_matrix(i) * local + i.position, aim), 1e-3F);
  }
}

TEST(RayScene, OccludedFindsWhatLiesBetween) {
  const Stage stage = wall_stage();
  RayCount count;
  const float far = std::numeric_limits<float>::infinity();
  const Ray through{{40, 20, 5}, {1, 0, 0}};
  EXPECT_TRUE(stage.rays->occluded(through, 0, far, count));
  EXPECT_FALSE(stage.rays->occluded(through, 0, 9.9F, count));
  EXPECT_TRUE(stage.rays->occluded(through, 0, 10.1F, count));
  EXPECT_FALSE(stage.rays->occluded(through, 10.1F, far, count));
  EXPECT_FALSE(stage.rays->occluded({{40, 20, 5}, {-1, 0, 0}}, 0, far, count));
  EXPECT_TRUE(stage.rays->occluded({{40, 20, 5}, {0, 0, -1}}, 0, far, count));
}

TEST(RayScene, RaysThatAreNotFiniteMissWithoutHarm) {
  const Stage stage = wall_stage();
  RayCount count;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(stage.rays->intersect({{nan, 0, 5}, {1, 0, 0}}, 0, false, count).valid());
  EXPECT_TRUE(stage.rays->occluded({{0, 0, 5}, {nan, 0, 0}}, 0, 10, count));
}

TEST(RayScene, AHundredThousandTreesAreBuiltInSeconds) {
  World world = flat_world();
  world.materials.emplace_back(testing::sheet(Vec3(0.5F), Vec3(0)));
  constexpr int models = 5;
  constexpr int leaves = 3000;
  for (int m = 0; m < models; ++m) {
    TriangleMesh tree;
    for (int k = 0; k < leaves; ++k) {
      const Vec3 p = 8.0F * Vec3(random(k, 0) - 0.5F, random(k, 1) - 0.5F, random(k, m));
      const auto first = static_cast<std::uint32_t>(tree.positions.size());
      tree.positions.insert(tree.positions.end(),
                            {p, p + Vec3(0.1F, 0, 0), p + Vec3(0, 0.1F, 0.1F)});
      tree.triangles.push_back({first, first + 1, first + 2});
    }
    tree.parts = {{"sheet", 0, leaves}};
    world.models.push_back({std::move(tree), {0}});
  }
  constexpr int trees = 100000;
  for (int k = 0; k < trees; ++k) {
    ModelInstance i;
    i.position = Vec3(2000 * (random(k, 5) - 0.5F), 2000 * (random(k, 6) - 0.5F), 0);
    i.yaw = 6 * random(k, 7);
    i.model = static_cast<std::uint32_t>(k % models);
    world.instances.push_back(i);
  }
  const auto start = std::chrono::steady_clock::now();
  const Stage stage(std::move(world));
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  EXPECT_LT(seconds.count(), 20);
  EXPECT_GE(stage.rays->all_triangles(), std::uint64_t{trees} * leaves);
  EXPECT_LT(stage.rays->unique_triangles(), std::uint64_t{40} * models * leaves);
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  EXPECT_LT(usage.ru_maxrss, 2000000);  // kB
  RayCount count;
  const Vec3 above = stage.world.instances[77].position + Vec3(0, 0, 50);
  EXPECT_TRUE(stage.rays->intersect({above, {0, 0, -1}}, 0, false, count).valid());
}

}  // namespace
}  // namespace wold
