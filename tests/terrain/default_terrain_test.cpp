#include "terrain/default_terrain.hpp"

#include "terrain/analysis.hpp"
#include "testing.hpp"

namespace wold {
namespace {

TEST(DefaultTerrain, IsHillyAndWalkableForEverySeed) {
  const OperatorList operators = terrain_operators();
  const std::vector<TerrainStep> steps = default_terrain(operators);
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Progress progress;
    const Heightfield field =
        evaluate({.size = 3000, .resolution = 129}, steps, operators, seed, {}, progress).field;
    const HeightStatistics heights = height_statistics(field);
    EXPECT_GT(heights.max - heights.min, 150) << seed;
    EXPECT_LT(heights.max - heights.min, 600) << seed;
    const Grid<float> slope = slope_map(field);
    double sum = 0;
    for (const float s : slope.values()) sum += s;
    EXPECT_GT(sum / (129 * 129), 8) << seed;
    EXPECT_LT(sum / (129 * 129), 22) << seed;
  }
}

}  // namespace
}  // namespace wold
