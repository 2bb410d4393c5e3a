#include "erosion/snow.hpp"

#include <cmath>

#include "testing.hpp"

namespace wold {
namespace {

using namespace testing_erosion;

TEST(Snow, LiesAsDeepAsItFallsOnGentleGround) {
  const Heightfield ground = field_of(20, 30, 10, {}, [](DVec2 p) { return 1000 + 0.3 * p.x; });
  const TerrainResult result = run(snow, ground, Snow{});
  for (const float depth : result.maps.at("snow").values()) EXPECT_NEAR(depth, 3, 1e-4);
  EXPECT_NEAR(result.field.height(7, 8), ground.height(7, 8) + 3, 1e-3);
  expect_balanced(result, {"snow"});
}

TEST(Snow, FallsAboveTheSnowLine) {
  const Heightfield ground = field_of(101, 5, 10, {}, [](DVec2 p) { return 0.6 * p.x; });
  const Grid<float> depth = run(snow, ground, Snow{}).maps.at("snow");
  EXPECT_EQ(depth(24, 2), 0);            // 144 m
  EXPECT_NEAR(depth(50, 2), 1.5, 0.01);  // 300 m
  EXPECT_NEAR(depth(76, 2), 3, 1e-3);    // 456 m
}

TEST(Snow, SlidesOffCliffsAndLiesAtTheirFeet) {
  // 60 degrees between two plains.
  const double steep = std::tan(radians(60.0));
  const Heightfield ground = field_of(
      121, 9, 5, {}, [&](DVec2 p) { return 1000 + steep * (std::clamp(p.x, 200.0, 300.0) - 200); });
  const TerrainResult result = run(snow, ground, Snow{});
  const Grid<float>& depth = result.maps.at("snow");
  EXPECT_LT(depth(50, 4), 0.2F);
  EXPECT_GT(depth(40, 4), 10);
  EXPECT_NEAR(depth(5, 4), 3, 1e-3);
  expect_balanced(result, {"snow"});
  for (std::size_t k = 0; k < depth.size(); ++k)
    EXPECT_GE(result.field.height.values()[k], ground.height.values()[k]);
}

TEST(Snow, RestsOnMountains) {
  const Heightfield ground = mountains(129);
  Snow parameters;
  parameters.angle = 35;
  for (const int passes : {1, 1000}) {
    parameters.max_passes = passes;
    const TerrainResult result = run(snow, ground, parameters);
    expect_balanced(result, {"snow"});
    const Grid<float>& depth = result.maps.at("snow");
    const Grid<float>& height = result.field.height;
    const auto most = static_cast<float>(std::tan(radians(35.51)) * ground.cell);
    for (int j = 0; j < 128; ++j)
      for (int i = 0; i < 128; ++i) {
        const float east = height(i, j) - height(i + 1, j);
        const float north = height(i, j) - height(i, j + 1);
        EXPECT_FALSE(depth(i, j) > 0.02F && std::max(east, north) > most) << i << ' ' << j;
        EXPECT_FALSE(depth(i + 1, j) > 0.02F && -east > most) << i << ' ' << j;
        EXPECT_FALSE(depth(i, j + 1) > 0.02F && -north > most) << i << ' ' << j;
      }
  }
}

TEST(Snow, DriftsIntoTheLee) {
  const Heightfield ridge =
      field_of(41, 5, 10, {}, [](DVec2 p) { return 1000 - 0.4 * std::abs(p.x - 200); });
  Snow parameters;
  parameters.drift = 1;
  const Grid<float> depth = run(snow, ridge, parameters).maps.at("snow");
  EXPECT_NEAR(depth(10, 2), 3 * 0.6, 0.01);
  EXPECT_NEAR(depth(30, 2), 3 * 1.4, 0.01);
}

TEST(Snow, SameBitsForAnyNumberOfThreads) {
  const Heightfield ground = mountains(150);
  expect_same_for_any_threads([&] { return run(snow, ground, Snow{}); });
}

TEST(Snow, CanBeCancelled) {
  expect_stays_cancelled(snow, mountains(33), Snow{});
}

TEST(Snow, ErrorsNameTheParameter) {
  Snow parameters;
  parameters.depth = -1;
  EXPECT_NE(error_text([&] { run(snow, mountains(9), parameters); }).find("depth"),
            std::string::npos);
}

}  // namespace
}  // namespace wold
