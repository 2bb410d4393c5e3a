#include "erosion/dissolution.hpp"

#include <gtest/gtest.h>

#include "water_testing.hpp"

namespace wold {
namespace {

using namespace testing_water;

Grid<float> lake_over(const Heightfield& bed, float level) {
  Grid<float> water(bed.height.width(), bed.height.height());
  for (std::size_t k = 0; k < water.size(); ++k)
    water.values()[k] = std::max(0.0F, level - bed.height.values()[k]);
  return water;
}

TEST(Dissolution, StillLakeThatHoldsNothingStays) {
  const Heightfield bed =
      field_of(50, 40, 5, {0, 0}, [](DVec2 x) { return std::round(4096 * bumps(x)) / 4096; });
  const Grid<float> water = lake_over(bed, 20);
  Dissolution p;
  p.rain = p.evaporation = p.saturation = 0;
  p.border = WaterBorder::closed;
  p.water = "lake";
  p.duration = 1;
  const TerrainResult result = run_with(dissolution, bed, p, {{"lake", water}});
  EXPECT_EQ(result.maps.at("water"), water);
  EXPECT_EQ(result.field.height, bed.height);
}

// d s / dt = K (K_s d - s): a pool on level ground takes up K_s d (1 - e^(-K t)); what is dissolved
// sinks again at the end, so it is seen in "carried".
TEST(Dissolution, PoolSaturatesExponentially) {
  const Heightfield flat = field_of(12, 12, 10, {0, 0}, [](DVec2) { return 0; });
  Dissolution p;
  p.rain = p.evaporation = 0;
  p.saturation = 0.003F;
  p.dissolving = 0.5F;
  p.duration = 3;
  p.border = WaterBorder::closed;
  p.water = "pool";
  const TerrainResult result = run_with(dissolution, flat, p, {{"pool", Grid<float>(12, 12, 2)}});
  EXPECT_NEAR(result.maps.at("carried")(5, 5), 0.003 * 2 * (1 - std::exp(-1.5)), 1e-5);
}

TEST(Dissolution, MassIsKeptWhateverTheBorder) {
  for (const WaterBorder border : {WaterBorder::open, WaterBorder::closed, WaterBorder::periodic}) {
    Dissolution p;
    p.border = border;
    p.duration = 10;
    expect_balanced(run_with(dissolution, hills(65, 47, 10), p));
  }
}

// Deeper water holds more, so a hole would dig itself ever deeper.
TEST(Dissolution, WaterDigsNoHoles) {
  const Heightfield land = hills(65, 65, 5);
  const auto deepest_hole = [](const Heightfield& f) {
    float deepest = 0;
    for (int j = 1; j < 64; ++j)
      for (int i = 1; i < 64; ++i) {
        const float around = std::min(
            {f.height(i - 1, j), f.height(i + 1, j), f.height(i, j - 1), f.height(i, j + 1)});
        deepest = std::max(deepest, around - f.height(i, j));
      }
    return deepest;
  };
  Dissolution p;
  p.saturation = 1;
  const TerrainResult result = run_with(dissolution, land, p);
  EXPECT_GT(result.maps.at("wear")(32, 32) + result.maps.at("sediment")(32, 32), 0);
  EXPECT_LT(deepest_hole(result.field), 0.1F);
}

TEST(Dissolution, LakeBedsBecomeSmooth) {
  const Heightfield basin = field_of(64, 64, 10, {0, 0}, [](DVec2 x) {
    return 0.0004 * std::pow(glm::length(x - 315.0), 2) +
           2 * std::sin(x.x / 12) * std::sin(x.y / 14);
  });
  Dissolution p;
  p.border = WaterBorder::closed;
  const auto roughness = [](const Heightfield& f) {
    double sum = 0;
    for (int j = 28; j < 36; ++j)
      for (int i = 28; i < 36; ++i)
        sum += std::pow(
            static_cast<double>(f.height(i + 1, j) + f.height(i - 1, j) + f.height(i, j + 1) +
                                f.height(i, j - 1) - 4 * f.height(i, j)),
            2);
    return std::sqrt(sum);
  };
  EXPECT_LT(roughness(run_with(dissolution, basin, p).field), 0.5 * roughness(basin));
}

TEST(Dissolution, SameBitsForAnyNumberOfThreads) {
  Dissolution p;
  p.duration = 5;
  const Heightfield land = hills(90, 77, 8);
  expect_same_for_any_threads([&] { return run_with(dissolution, land, p); });
}

TEST(Dissolution, SmallestLand) {
  Dissolution p;
  p.duration = 2;
  for (const auto& [w, h] : {std::pair{2, 2}, {2, 5}, {5, 2}})
    for (const WaterBorder border :
         {WaterBorder::open, WaterBorder::closed, WaterBorder::periodic}) {
      p.border = border;
      const TerrainResult result = run_with(dissolution, hills(w, h, 10), p);
      for (const float height : result.field.height.values()) EXPECT_TRUE(std::isfinite(height));
    }
}

TEST(Dissolution, CanBeCancelled) {
  expect_cancels(dissolution, hills(200, 200, 5), Dissolution{});
}

TEST(Dissolution, ErrorsNameTheParameter) {
  Dissolution p;
  p.saturation = -1;
  EXPECT_NE(error_text([&] {
              run_with(dissolution, hills(8, 8, 10), p);
            }).find("'saturation' in 'dissolution'"),
            std::string::npos);
}

}  // namespace
}  // namespace wold
