#include "erosion/layers.hpp"

#include <gtest/gtest.h>

#include "water_testing.hpp"

namespace wold {
namespace {

using namespace testing_water;

/// Two layers, hard over soft, level; no water.
Layers cap_over_shale() {
  Layers p;
  p.thickness = {20, 60};
  p.layer_hardness = {0.8, 0.1};
  p.layer_angle = {75, 30};
  p.layer_capacity = {1, 1};
  p.top = 80;
  p.dip = 0;
  p.undulation = 0;
  p.water.rain = 0;
  p.water.lakes = false;
  p.water.start_cell = 0.001F;
  p.water.duration = 1;
  return p;
}

TEST(Layers, HardOnesStandAsCliffsAndSoftOnesLieBack) {
  // A wall of 53° from 0 to 80 m.
  const Heightfield wall = field_of(
      120, 6, 4, {0, 0}, [](DVec2 x) { return std::clamp(4.0 / 3 * (x.x - 240), 0.0, 80.0); });
  const TerrainResult result = run_with(layers, wall, cap_over_shale());
  const Grid<float>& h = result.field.height;
  double steepest_soft = 0;
  double steepest_hard = 0;
  for (int i = 0; i + 1 < h.width(); ++i) {
    const double slope = static_cast<double>(h(i + 1, 3) - h(i, 3)) / 4;
    if (h(i + 1, 3) < 59) steepest_soft = std::max(steepest_soft, slope);
    if (h(i, 3) >= 60) steepest_hard = std::max(steepest_hard, slope);
  }
  EXPECT_NEAR(degrees(std::atan(steepest_soft)), 32, 3.5);  // rock 30, scree 33
  EXPECT_GT(degrees(std::atan(steepest_hard)), 50);
  EXPECT_LE(degrees(std::atan(steepest_hard)), 76);
}

TEST(Layers, SofterLayersAreWornMore) {
  const Heightfield slope = field_of(100, 60, 8, {0, 0}, [](DVec2 x) { return 0.2 * x.x; });
  const auto worn = [&](double hardness) {
    Layers p;
    p.thickness = {80, 80};
    p.layer_hardness = {hardness, 0.5};
    p.layer_angle = {80, 80};
    p.layer_capacity = {1, 1};
    p.dip = p.undulation = 0;
    p.water.unevenness = 0;
    p.water.duration = 0.3F;
    const TerrainResult result = run_with(layers, slope, p);
    double sum = 0;
    for (int j = 5; j < 55; ++j)
      for (int i = 60; i < 95; ++i) sum += static_cast<double>(result.maps.at("wear")(i, j));
    return sum;
  };
  EXPECT_GT(worn(0), 2 * worn(0.9));
  EXPECT_LT(worn(1), 0.2 * worn(0));
}

TEST(Layers, MapsTellTheLayer) {
  const Heightfield slope = field_of(41, 4, 10, {0, 0}, [](DVec2 x) { return 0.2 * x.x; });
  Layers p = cap_over_shale();
  p.water.duration = 0;
  const TerrainResult result = run_with(layers, slope, p);
  EXPECT_EQ(result.maps.at("layer")(39, 2), 0);
  EXPECT_EQ(result.maps.at("layer")(10, 2), 1);
  EXPECT_NEAR(result.maps.at("strata")(10, 2), 80 - 20, 1e-4);
}

TEST(Layers, MassIsKeptWhateverTheBorder) {
  for (const WaterBorder border : {WaterBorder::open, WaterBorder::closed, WaterBorder::periodic}) {
    Layers p;
    p.water.border = border;
    p.water.duration = 0.3F;
    p.water.start_cell = 25;
    expect_balanced(run_with(layers, hills(65, 47, 10), p));
  }
}

TEST(Layers, SameBitsForAnyNumberOfThreads) {
  Layers p;
  p.water.duration = 0.1F;
  const Heightfield land = hills(70, 61, 10);
  expect_same_for_any_threads([&] { return run_with(layers, land, p); });
}

TEST(Layers, CanBeCancelled) {
  expect_cancels(layers, hills(150, 150, 8), Layers{});
}

TEST(Layers, ErrorsNameTheParameter) {
  const auto message = [](const Layers& p) {
    return error_text([&] { run_with(layers, hills(8, 8, 10), p); });
  };
  Layers p;
  p.thickness.pop_back();
  EXPECT_NE(message(p).find("'layer_hardness' needs one number for each 'thickness'"),
            std::string::npos);
  p = {};
  p.layer_angle[1] = 90;
  EXPECT_NE(message(p).find("'layer_angle'"), std::string::npos);
  p = {};
  p.thickness.clear();
  EXPECT_NE(message(p).find("'thickness'"), std::string::npos);
  p = {};
  p.water.rain = -1;
  EXPECT_NE(message(p).find("'rain' in 'layers'"), std::string::npos);
}

}  // namespace
}  // namespace wold
