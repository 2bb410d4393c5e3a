#include "erosion/pipes.hpp"

#include <gtest/gtest.h>

#include "../terrain/testing.hpp"
#include "base/hash.hpp"
#include "base/parallel.hpp"
#include "terrain/resample.hpp"

namespace wold {
namespace {

using namespace testing_terrain;

/// Runs pipes with maps by name.
TerrainResult run_with(const Heightfield& input, const Pipes& p,
                       const std::map<std::string, Grid<float>>& maps = {}) {
  Progress progress;
  const std::map<std::string, TerrainResult> none;
  const TerrainContext context{1, {input.origin, input.size()}, {}, none, progress, &maps};
  return pipes(input, p, context);
}

/// Water that only moves: nothing is worn.
Pipes clear_water() {
  Pipes p;
  p.rain = 0;
  p.capacity = 0;
  p.lakes = false;
  p.border = WaterBorder::closed;
  p.start_cell = 0.001F;
  return p;
}

double bumps(DVec2 x) {
  return 40 * std::sin(x.x / 70) * std::cos(x.y / 90) + 12 * std::sin(x.x / 23 + x.y / 31);
}

Heightfield hills(int width, int height, double cell) {
  return field_of(width, height, cell, {0, 0}, [](DVec2 x) {
    return 500 + 0.1 * x.x + bumps(x) + 3 * std::sin(x.x / 7) * std::sin(x.y / 9);
  });
}

void expect_balanced(const TerrainResult& result) {
  ASSERT_EQ(result.balances.size(), 2U);
  for (const Balance& b : result.balances) {
    EXPECT_GT(b.moved, 0) << b.quantity;
    EXPECT_LE(std::abs(b.error()), 1e-6 * b.moved) << b.quantity;
  }
}

TEST(Pipes, StillLakeStaysFlat) {
  const Heightfield bed =
      field_of(60, 40, 5, {0, 0}, [](DVec2 x) { return std::round(4096 * bumps(x)) / 4096; });
  Grid<float> water(60, 40);
  for (std::size_t k = 0; k < water.size(); ++k)
    water.values()[k] = std::max(0.0F, 20 - bed.height.values()[k]);
  Pipes p = clear_water();
  p.water = "lake";
  p.duration = 0.2F;
  p.capacity = 1;
  const TerrainResult result = run_with(bed, p, {{"lake", water}});
  EXPECT_EQ(result.maps.at("water"), water);
  EXPECT_EQ(result.field.height, bed.height);
  for (const float v : result.maps.at("velocity").values()) EXPECT_EQ(v, 0);
}

TEST(Pipes, MassIsKeptWhateverTheBorder) {
  for (const WaterBorder border : {WaterBorder::open, WaterBorder::closed, WaterBorder::periodic}) {
    Pipes p;
    p.border = border;
    p.duration = 0.3F;
    p.evaporation = 0.5F;
    p.start_cell = 25;
    p.spring_places = {300, 200};
    p.spring_rates = {5};
    expect_balanced(run_with(hills(65, 47, 10), p));
  }
}

TEST(Pipes, SameBitsForAnyNumberOfThreads) {
  Pipes p;
  p.duration = 0.2F;
  const Heightfield land = hills(150, 133, 8);
  const auto with_threads = [&](int threads) {
    const ThreadLimit limit(threads);
    return run_with(land, p);
  };
  const TerrainResult one = with_threads(1);
  for (const int threads : {1, 2, 4}) {
    const TerrainResult other = with_threads(threads);
    EXPECT_EQ(one.field.height, other.field.height);
    EXPECT_EQ(one.maps, other.maps);
  }
}

TEST(Pipes, SmallestAndNarrowLand) {
  for (const auto& [w, h] : {std::pair{2, 2}, {2, 5}, {5, 2}, {3, 70}}) {
    Pipes p;
    p.duration = 0.05F;
    for (const WaterBorder border :
         {WaterBorder::open, WaterBorder::closed, WaterBorder::periodic}) {
      p.border = border;
      const TerrainResult result = run_with(hills(w, h, 10), p);
      for (const float height : result.field.height.values()) EXPECT_TRUE(std::isfinite(height));
    }
  }
}

}  // namespace
}  // namespace wold
