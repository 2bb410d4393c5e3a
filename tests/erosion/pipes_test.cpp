#include "erosion/pipes.hpp"

#include <gtest/gtest.h>

#include "terrain/resample.hpp"
#include "water_testing.hpp"

namespace wold {
namespace {

using namespace testing_water;

constexpr double gravity = 9.81;

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

/// As much rain as in the whole world, but nothing random and one grid.
Pipes plain_rain() {
  Pipes p;
  p.unevenness = 0;
  p.start_cell = 0.001F;
  return p;
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
  for (const bool momentum : {true, false}) {
    p.momentum = momentum;
    const TerrainResult result = run_with(pipes, bed, p, {{"lake", water}});
    EXPECT_EQ(result.maps.at("water"), water);
    EXPECT_EQ(result.field.height, bed.height);
    for (const float v : result.maps.at("velocity").values()) EXPECT_EQ(v, 0);
  }
}

// v² = g d S / c and q = v d = rain · way: no inertia left, the same at each place of the plane.
TEST(Pipes, RainRunsDownAPlaneWithItsSpeed) {
  const double slope = 0.1;
  const Heightfield plane =
      field_of(120, 8, 5, {0, 0}, [&](DVec2 x) { return 1000 - slope * x.x; });
  Pipes p = clear_water();
  p.rain = 100;
  p.duration = 1;
  p.border = WaterBorder::open;
  const TerrainResult result = run_with(pipes, plane, p);
  for (const int i : {40, 80, 110}) {
    const double q = 0.1 / 3600 * 5 * (i + 0.5);
    const double speed = std::cbrt(q * gravity * slope / static_cast<double>(p.drag));
    EXPECT_NEAR(result.maps.at("velocity_x")(i, 4), speed, 0.03 * speed);
    EXPECT_NEAR(result.maps.at("water")(i, 4), q / speed, 0.03 * q / speed);
  }
}

// A slope between 4/9 and 4 times the drag: without momentum waves roll down it.
TEST(Pipes, SteepRiversRunSmoothly) {
  const Heightfield plane = field_of(400, 4, 4, {0, 0}, [](DVec2 x) { return 500 - 0.1 * x.x; });
  Pipes p = clear_water();
  p.spring_places = {20, 6};
  p.spring_rates = {20};
  p.duration = 0.4F;
  const auto roughness = [&](bool momentum) {
    p.momentum = momentum;
    const Grid<float> water = run_with(pipes, plane, p).maps.at("water");
    float least = 1e9F;
    float most = 0;
    for (int i = 200; i < 330; ++i) {
      least = std::min(least, water(i, 1));
      most = std::max(most, water(i, 1));
    }
    return most / least - 1;
  };
  EXPECT_LT(roughness(true), 0.001F);
  EXPECT_GT(roughness(false), 0.1F);
}

// Off a cone it runs alike in every direction, along the grid as across it.
TEST(Pipes, RainRunsOffAConeAlikeInAllDirections) {
  const int n = 121;
  const Heightfield cone =
      field_of(n, n, 10, {-600, -600}, [](DVec2 x) { return 1000 - 0.2 * glm::length(x); });
  Pipes p = clear_water();
  p.rain = 40;
  p.duration = 0.7F;
  p.border = WaterBorder::open;
  const TerrainResult result = run_with(pipes, cone, p);
  for (const double angle : {10.0, 25.0, 45.0}) {
    double depth = 0;
    for (int k = 0; k < 40; ++k) {
      const double radius = 35 + 0.25 * k;
      const DVec2 at = radius * DVec2(std::cos(radians(angle)), std::sin(radians(angle)));
      depth += result.maps.at("water")(60 + static_cast<int>(std::lround(at.x)),
                                       60 + static_cast<int>(std::lround(at.y))) /
               40.0;
    }
    const double q = 0.04 / 3600 * 0.5 * 400;
    const double expected = q / std::cbrt(q * gravity * 0.196 / static_cast<double>(p.drag));
    EXPECT_NEAR(depth, expected, 0.03 * expected) << angle;
  }
}

TEST(Pipes, WaterEvaporatesExponentially) {
  const Heightfield flat = field_of(10, 10, 10, {0, 0}, [](DVec2) { return 0; });
  Pipes p = clear_water();
  p.water = "pool";
  p.evaporation = 2;
  p.duration = 0.5F;
  const TerrainResult result = run_with(pipes, flat, p, {{"pool", Grid<float>(10, 10, 3)}});
  EXPECT_NEAR(result.maps.at("water")(4, 4), 3 * std::exp(-1.0), 1e-3);
}

TEST(Pipes, SpringsGiveTheirRate) {
  Pipes p = clear_water();
  p.spring_places = {200, 150, 420, 300};
  p.spring_rates = {3, 4.5};
  p.duration = 0.25F;
  const TerrainResult result = run_with(pipes, hills(65, 47, 10), p);
  EXPECT_NEAR(result.balances[1].added, 7.5 * 900, 0.001 * 7.5 * 900);
  EXPECT_NEAR(result.balances[1].after, result.balances[1].added, 1e-6 * result.balances[1].added);
}

TEST(Pipes, MassIsKeptWhateverTheBorder) {
  for (const WaterBorder border : {WaterBorder::open, WaterBorder::closed, WaterBorder::periodic}) {
    Pipes p;
    p.border = border;
    p.momentum = border != WaterBorder::closed;
    p.duration = 0.3F;
    p.evaporation = 0.5F;
    p.start_cell = 25;
    p.spring_places = {300, 200};
    p.spring_rates = {5};
    expect_balanced(run_with(pipes, hills(65, 47, 10), p));
  }
}

TEST(Pipes, SameBitsForAnyNumberOfThreads) {
  Pipes p;
  p.duration = 0.05F;
  const Heightfield land = hills(150, 133, 8);
  for (const bool momentum : {false, true}) {
    p.momentum = momentum;
    expect_same_for_any_threads([&] { return run_with(pipes, land, p); });
  }
}

TEST(Pipes, SymmetricLandStaysSymmetric) {
  const int n = 64;
  const Heightfield land = field_of(n, n, 10, {0, 0}, [](DVec2 x) {
    const DVec2 phase = (x + 5.0) * (2 * pi_d / 640);
    return 100 + 30 * std::cos(phase.x) * std::cos(phase.y) + 8 * std::cos(3 * phase.x) +
           8 * std::cos(3 * phase.y);
  });
  Pipes p = plain_rain();
  p.momentum = true;
  p.border = WaterBorder::periodic;
  p.duration = 0.3F;
  const TerrainResult result = run_with(pipes, land, p);
  const Grid<float>& h = result.field.height;
  float asymmetry = 0;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
      asymmetry =
          std::max({asymmetry, std::abs(h(i, j) - h(n - 1 - i, j)), std::abs(h(i, j) - h(j, i))});
  EXPECT_GT(result.balances[0].moved, 1000);
  EXPECT_LT(asymmetry, 0.02F);
}

class PipesWith : public ::testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(Momentum, PipesWith, ::testing::Bool());

TEST_P(PipesWith, SameLandAtOtherResolutions) {
  Pipes p;
  p.momentum = GetParam();
  p.duration = 0.5F;
  p.start_cell = 40;
  std::vector<Grid<float>> heights;
  const Heightfield like = hills(97, 97, 10);
  for (const int finer : {1, 2, 4}) {
    const Heightfield land = hills(96 * finer + 1, 96 * finer + 1, 10.0 / finer);
    const TerrainResult result = run_with(pipes, land, p);
    Progress progress;
    heights.push_back(
        resample(result.field.height, {like.origin, like.size()}, Outside::clamp, like, progress));
  }
  const auto [low, high] =
      std::minmax_element(heights[0].values().begin(), heights[0].values().end());
  for (const std::size_t other : {1U, 2U}) {
    double square = 0;
    for (std::size_t k = 0; k < like.height.size(); ++k)
      square +=
          std::pow(static_cast<double>(heights[0].values()[k] - heights[other].values()[k]), 2);
    EXPECT_LT(std::sqrt(square / static_cast<double>(like.height.size())),
              0.05 * static_cast<double>(*high - *low));
  }
}

TEST(Pipes, HardGroundIsNotWorn) {
  const Heightfield land = hills(65, 47, 10);
  Grid<float> hardness(65, 47);
  for (int j = 0; j < 47; ++j)
    for (int i = 0; i < 32; ++i) hardness(i, j) = 1;
  Pipes p = plain_rain();
  p.duration = 0.2F;
  p.bank_angle = 89;
  p.stirring = 0;
  p.hardness = "rock";
  const auto worn = [&](bool invert) {
    p.hardness_invert = invert;
    const TerrainResult result = run_with(pipes, land, p, {{"rock", hardness}});
    std::array<double, 2> sums{};
    for (int j = 0; j < 47; ++j)
      for (int i = 0; i < 65; ++i)
        if (std::abs(i - 32) > 3)
          sums[i < 32 ? 0 : 1] += static_cast<double>(result.maps.at("wear")(i, j));
    return sums;
  };
  EXPECT_LT(worn(false)[0], 0.02 * worn(false)[1]);
  EXPECT_LT(worn(true)[1], 0.02 * worn(true)[0]);
}

TEST(Pipes, SmallestAndNarrowLand) {
  for (const auto& [w, h] : {std::pair{2, 2}, {2, 5}, {5, 2}, {3, 70}}) {
    Pipes p;
    p.duration = 0.05F;
    for (const WaterBorder border :
         {WaterBorder::open, WaterBorder::closed, WaterBorder::periodic}) {
      p.border = border;
      const TerrainResult result = run_with(pipes, hills(w, h, 10), p);
      for (const float height : result.field.height.values()) EXPECT_TRUE(std::isfinite(height));
    }
  }
}

TEST(Pipes, CanBeCancelled) {
  expect_cancels(pipes, hills(200, 200, 5), Pipes{});
}

TEST(Pipes, ErrorsNameTheParameter) {
  const Heightfield land = hills(20, 20, 10);
  const auto message = [&](const Pipes& p, const std::map<std::string, Grid<float>>& maps = {}) {
    return error_text([&] { run_with(pipes, land, p, maps); });
  };
  Pipes p;
  p.rain = -1;
  EXPECT_NE(message(p).find("'rain' in 'pipes'"), std::string::npos);
  p = {};
  p.spring_places = {1, 2, 3};
  p.spring_rates = {1};
  EXPECT_NE(message(p).find("an x and a y for each of the 'spring_rates'"), std::string::npos);
  p.spring_places = {1, 5000};
  EXPECT_NE(message(p).find("not on the land"), std::string::npos);
  p = {};
  p.water = "sea";
  EXPECT_NE(message(p, {{"sea", Grid<float>(20, 20, 1e4F)}}).find("0 to 300 m"), std::string::npos);
  p.water = "nowhere";
  EXPECT_NE(error_text([&] { run_with(pipes, land, p); }, ErrorKind::io).find("nowhere"),
            std::string::npos);
}

}  // namespace
}  // namespace wold
