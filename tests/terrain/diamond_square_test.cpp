#include "terrain/diamond_square.hpp"

#include <algorithm>

#include "base/parallel.hpp"
#include "testing.hpp"

namespace wold {
namespace {

using testing_terrain::Steps;

Grid<float> map_of(const DiamondSquare& parameters, std::uint64_t seed = 1) {
  Progress progress;
  return diamond_square_map(parameters, seed, progress);
}

TEST(DiamondSquare, WithoutSpreadEachSampleIsTheMeanOfItsCorners) {
  const Grid<float> h = map_of({.levels = 3, .corner_height = 100, .spread = 0});
  ASSERT_EQ(h.width(), 9);
  EXPECT_NEAR(h(4, 4), (h(0, 0) + h(8, 0) + h(0, 8) + h(8, 8)) / 4, 1e-4);
  EXPECT_NEAR(h(4, 0), (h(0, 0) + h(8, 0) + h(4, 4)) / 3, 1e-4);  // at the border: three
  EXPECT_NEAR(h(8, 4), (h(8, 0) + h(8, 8) + h(4, 4)) / 3, 1e-4);
  EXPECT_NEAR(h(2, 2), (h(0, 0) + h(4, 0) + h(0, 4) + h(4, 4)) / 4, 1e-4);
  EXPECT_NEAR(h(4, 2), (h(4, 0) + h(4, 4) + h(2, 2) + h(6, 2)) / 4, 1e-4);  // inside: four
  EXPECT_NEAR(h(3, 4), (h(2, 4) + h(4, 4) + h(3, 3) + h(3, 5)) / 4, 1e-4);
}

TEST(DiamondSquare, DisplacementsStayWithinTheSpreadOfTheirLevel) {
  const float spread = 50;
  const float reduction = 0.4F;
  const Grid<float> h =
      map_of({.levels = 5, .corner_height = 0, .spread = spread, .spread_reduction = reduction});
  float level_spread = spread;
  for (int half = 16; half > 0; half /= 2) {
    float largest = 0;
    for (int j = half; j < 32; j += 2 * half)
      for (int i = half; i < 32; i += 2 * half) {
        const float mean = (h(i - half, j - half) + h(i + half, j - half) + h(i - half, j + half) +
                            h(i + half, j + half)) /
                           4;
        largest = std::max(largest, std::abs(h(i, j) - mean));
      }
    EXPECT_LE(largest, level_spread * 1.0001F);
    if (half < 8) {
      EXPECT_GT(largest, 0.8F * level_spread);
    }
    level_spread *= reduction;
  }
}

TEST(DiamondSquare, LowestIsZeroAndCornersDifferByAtMostTwiceTheirHeight) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const Grid<float> h = map_of({.levels = 4, .corner_height = 30, .spread = 10}, seed);
    EXPECT_EQ(*std::min_element(h.values().begin(), h.values().end()), 0);
    EXPECT_LE(std::abs(h(0, 0) - h(16, 16)), 60);
  }
}

TEST(DiamondSquare, SameBitsForAnyNumberOfThreadsAndOtherBitsForAnotherSeed) {
  const DiamondSquare parameters{.levels = 7};
  std::vector<Grid<float>> maps;
  for (const int threads : {1, 2, 4}) {
    const ThreadLimit limit(threads);
    maps.push_back(map_of(parameters));
  }
  EXPECT_EQ(maps[0], maps[1]);
  EXPECT_EQ(maps[0], maps[2]);
  EXPECT_NE(maps[0], map_of(parameters, 2));
}

TEST(DiamondSquare, TerrainAtItsOwnResolutionIsTheMapAndIsMirroredOutside) {
  Steps steps;
  steps.add("diamond_square", {{"levels", std::int64_t{6}}});
  const TerrainSettings settings{.size = 640, .resolution = 65};
  const Grid<float> whole = steps.evaluate(settings).field.height;
  EXPECT_NEAR(*std::min_element(whole.values().begin(), whole.values().end()), 0, 1e-3);
  const TerrainWindow east{{320, -320}, 10, 65, 65};
  const Grid<float> beyond = steps.evaluate(settings, east).field.height;
  for (int i = 0; i < 65; i += 8) EXPECT_NEAR(beyond(i, 20), whole(64 - i, 20), 1e-2);
}

}  // namespace
}  // namespace wold
