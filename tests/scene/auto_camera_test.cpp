// The camera that finds itself a view: 200 landscapes, and none without ground and sky, and trees
// where there are any; never in the ground.

#include "render/auto_camera.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "base/parallel.hpp"
#include "scene/build.hpp"

namespace wold {
namespace {

constexpr const char* forest = R"(
[terrain]
size = 500
resolution = 129
[surroundings]
factor = 3
resolution = 65
[[terrain.step]]
op = "fbm"
height = 120
feature_size = 600
octaves = 5
[[species]]
name = "tree"
plant = "tree.lsys"
height = [8, 15]
models = 2
[[species]]
name = "herb"
plant = "tree.lsys"
height = [0.1, 0.3]
models = 1
[[scatter]]
species = { tree = 1 }
density = 0.01
[[scatter]]
species = { herb = 1 }
density = 1
within = 10
[render]
size = [64, 36]
dicing = 8
)";

constexpr const char* mountains = R"(
[terrain]
size = 4000
resolution = 129
[surroundings]
factor = 3
resolution = 65
[[terrain.step]]
op = "ridged"
height = 1400
feature_size = 2500
[render]
size = [64, 36]
dicing = 8
)";

constexpr const char* small_tree = R"(// A stem with forks and some large leaves.
iterations 3
organ A shape leaf material leaf length 1.6 width 1.2
axiom: F(1)B
p1: B -> [+(50)F(0.8)~A][-(50)F(0.8)~A]/(90)F(0.7)B
)";

std::filesystem::path folder_with_tree() {
  auto folder = std::filesystem::path(::testing::TempDir()) / "wold_auto_camera";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "tree.lsys") << small_tree;
  return folder;
}

BuiltScene built(const std::string& text, const std::filesystem::path& folder, int seed,
                 const std::vector<std::string>& more = {}) {
  std::vector<std::string> overrides{"seed=" + std::to_string(seed)};
  overrides.insert(overrides.end(), more.begin(), more.end());
  Progress progress;
  return build(parse_scene(text, "scene.toml", folder, overrides), "", progress);
}

/// Looking straight down from the camera there is ground, and straight up there is none.
void expect_above_ground(const BuiltScene& scene, int seed) {
  const Vec3 eye = scene.camera.position;
  RayCount count;
  const Hit below = scene.rays->intersect({eye, {0, 0, -1}}, 0, false, count);
  EXPECT_TRUE(below.valid()) << "seed " << seed;
  const Hit above = scene.rays->intersect({eye, {0, 0, 1}}, 0, false, count);
  EXPECT_TRUE(!above.valid() || above.instance != Hit::ground) << "seed " << seed;
  const GroundSample ground = scene.world->ground.detailed(DVec2(eye.x, eye.y), 0.05F);
  EXPECT_GT(eye.z, ground.height + 0.5F) << "seed " << seed;
}

void expect_landscape(const std::string& text, const std::filesystem::path& folder, int first,
                      int last, bool plants) {
  for (int seed = first; seed < last; ++seed) {
    const BuiltScene scene = built(text, folder, seed);
    ASSERT_EQ(!scene.world->instances.empty(), plants);
    const ViewStatistics v = look_around(*scene.rays, scene.camera, 16.0F / 9);
    const std::string which = "seed " + std::to_string(seed);
    EXPECT_GE(v.sky, 0.08F) << which;
    EXPECT_LE(v.sky, 0.75F) << which;
    EXPECT_GE(v.ground, 0.06F) << which;
    EXPECT_GE(v.sky_above, 0.2F) << which;
    EXPECT_LE(v.near_share, 0.02F) << which;
    EXPECT_GE(v.plants, plants ? 0.04F : 0.0F) << which;
    expect_above_ground(scene, seed);
  }
}

// In parts, which run side by side.
TEST(AutoCamera, ForestsSeeds0To50) {
  expect_landscape(forest, folder_with_tree(), 0, 50, true);
}
TEST(AutoCamera, ForestsSeeds50To100) {
  expect_landscape(forest, folder_with_tree(), 50, 100, true);
}
TEST(AutoCamera, ForestsSeeds100To140) {
  expect_landscape(forest, folder_with_tree(), 100, 140, true);
}
TEST(AutoCamera, MountainsSeeds0To60) {
  expect_landscape(mountains, {}, 0, 60, false);
}

TEST(AutoCamera, SameViewForAnyNumberOfThreads) {
  const auto with = [](int threads) {
    const ThreadLimit limit(threads);
    return built(forest, folder_with_tree(), 5).camera;
  };
  const Camera one = with(1);
  for (const int threads : {2, 4}) {
    EXPECT_EQ(with(threads).position, one.position);
    EXPECT_EQ(with(threads).direction, one.direction);
  }
}

TEST(AutoCamera, KeepsWhatIsGiven) {
  const auto with = [](const std::vector<std::string>& settings) {
    return built(mountains, {}, 1, settings);
  };
  const BuiltScene here = with({"camera.position=[100, -200]", "camera.look_height=7"});
  EXPECT_EQ(Vec2(here.camera.position), Vec2(100, -200));
  EXPECT_NEAR(here.camera.position.z - here.world->ground.base({100, -200}).height, 7, 1e-3F);
  const Camera there = with({"camera.look_direction=[0, 2, 0]"}).camera;
  EXPECT_EQ(there.direction, Vec3(0, 1, 0));
  const Camera given =
      with({"camera.position=[1, 2, 3000]", "camera.target=[1, 2, 0]", "camera.tilt=30"}).camera;
  EXPECT_EQ(given.position, Vec3(1, 2, 3000));
  EXPECT_NEAR(degrees(std::asin(given.direction.z)), -60, 0.1F);
  const Camera at = with({"camera.target=[0, 0, 500]"}).camera;
  const Vec3 to = glm::normalize(Vec3(0, 0, 500) - at.position);
  EXPECT_LT(glm::distance(at.direction, to), 1e-4F);
}

TEST(AutoCamera, KeepsAwayFromTheBorder) {
  for (int seed = 0; seed < 5; ++seed) {
    const Vec3 p = built(mountains, {}, seed, {"camera.edge_min_offset=1500"}).camera.position;
    EXPECT_LE(std::abs(p.x), 500);
    EXPECT_LE(std::abs(p.y), 500);
  }
}

TEST(AutoCamera, ListsOfTheWrongLengthAreRefused) {
  using List = std::vector<double>;
  const auto refused = [](const List& position, const List& target, const List& direction) {
    CameraSettings settings;
    settings.position = position;
    settings.target = target;
    settings.look_direction = direction;
    EXPECT_THROW(check_camera(settings), Error);
  };
  refused({1}, {}, {});
  refused({}, {1, 2}, {});
  refused({}, {}, {1, 2, 3, 4});
  refused({}, {}, {0, 0, 0});
  refused({1, 2, 3}, {1, 2, 3}, {});
  EXPECT_NO_THROW(check_camera({}));
}

}  // namespace
}  // namespace wold
