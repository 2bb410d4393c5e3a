#include "erosion/thermal.hpp"

#include <algorithm>
#include <cmath>

#include "base/hash.hpp"
#include "erosion/ground.hpp"
#include "terrain/analysis.hpp"
#include "testing.hpp"

namespace wold {
namespace {

using namespace testing_erosion;

Thermal sand() {
  Thermal parameters;
  parameters.cliff_angle = 0;
  return parameters;
}

/// A column of sand of a radius in the middle of a plain, whose cone would have `cone_radius`.
Heightfield column(int samples, double cell, double radius, double cone_radius) {
  const double middle = 0.5 * cell * (samples - 1);
  const double height = std::tan(radians(33.0)) * std::pow(cone_radius, 3) / 3 / (radius * radius);
  return field_of(samples, samples, cell, {},
                  [&](DVec2 p) { return glm::length(p - DVec2(middle)) < radius ? height : 0; });
}

/// The steepest slope down to any of eight neighbours from a sample that holds more loose material
/// than 2 % of a cell, degrees.
double steepest_loose(const Heightfield& field, const Grid<float>& loose) {
  double steepest = 0;
  for (int j = 0; j < loose.height(); ++j)
    for (int i = 0; i < loose.width(); ++i)
      for (int k = 0; k < 9; ++k) {
        const IVec2 to(i + k % 3 - 1, j + k / 3 - 1);
        if (static_cast<double>(loose(i, j)) <= 0.02 * field.cell || k == 4) continue;
        if (to.x < 0 || to.y < 0 || to.x >= loose.width() || to.y >= loose.height()) continue;
        const double drop = static_cast<double>(field.height(i, j)) - field.height(to.x, to.y);
        steepest = std::max(steepest, drop / (field.cell * std::hypot(to.x - i, to.y - j)));
      }
  return degrees(std::atan(steepest));
}

/// The angle of the flank from the middle in a direction, degrees.
double flank(const Heightfield& field, double direction, double from, double to) {
  const DVec2 middle = field.origin + 0.5 * field.size();
  const DVec2 along(std::cos(radians(direction)), std::sin(radians(direction)));
  const auto height = [&](double r) {
    return static_cast<double>(height_at(field, middle + r * along));
  };
  return degrees(std::atan((height(from) - height(to)) / (to - from)));
}

double foot(const Heightfield& field, double direction) {
  const DVec2 middle = field.origin + 0.5 * field.size();
  const DVec2 along(std::cos(radians(direction)), std::sin(radians(direction)));
  double r = 0;
  while (height_at(field, middle + r * along) > 1) r += 0.1 * field.cell;
  return r;
}

TEST(Thermal, SandFallsToARoundConeAtItsAngle) {
  for (const bool ladder : {false, true}) {
    Thermal parameters = sand();
    parameters.ladder = ladder;
    parameters.max_passes = 20000;
    const TerrainResult result = run(thermal, column(129, 4, 40, 160), parameters);
    for (const double direction : {0.0, 15.0, 22.5, 30.0, 45.0, 60.0, 90.0, 200.0}) {
      EXPECT_NEAR(flank(result.field, direction, 24, 130), 33, 0.5) << direction;
      EXPECT_NEAR(foot(result.field, direction), 160, ladder ? 16 : 4) << direction;
    }
    EXPECT_LT(steepest_step(result.field.height, 4), 33.5);
    expect_balanced(result, {"ground"});
  }
}

TEST(Thermal, ASpikeOfOneCellFallsToACone) {
  Heightfield field = field_of(65, 65, 2, {}, [](DVec2) { return 0; });
  field.height(32, 32) = 5000;
  const TerrainResult result = run(thermal, field, sand());
  // 20000 m³ of sand make a cone of radius (3 V / π tan 33°)^(1/3) = 30.9 m.
  for (const double direction : {0.0, 20.0, 45.0, 70.0})
    EXPECT_NEAR(foot(result.field, direction), 30.9, 5) << direction;
  EXPECT_NEAR(volume(result.field.height, 2), 20000, 0.02);
}

TEST(Thermal, NothingMovesBelowTheAngle) {
  const Heightfield slope = field_of(
      40, 30, 5, {}, [](DVec2 p) { return std::tan(radians(32.5)) * (0.8 * p.x + 0.6 * p.y); });
  EXPECT_EQ(run(thermal, slope, sand()).field.height, slope.height);
}

TEST(Thermal, AStepOfSandBecomesARampAboutItsMiddle) {
  const Heightfield step = field_of(121, 9, 1, {}, [](DVec2 p) { return p.x < 59.5 ? 20 : 0; });
  const TerrainResult result = run(thermal, step, sand());
  const double slope = std::tan(radians(33.0));
  for (int i = 0; i < 121; ++i)
    EXPECT_NEAR(static_cast<double>(result.field.height(i, 4)),
                std::clamp(10 - slope * (i - 59.5), 0.0, 20.0), 0.8)
        << i;
}

TEST(Thermal, NoSlopeStaysSteeperThanTheTolerance) {
  const Heightfield ground = mountains(97);
  for (const float angle : {20.0F, 33.0F, 45.0F}) {
    Thermal parameters = sand();
    parameters.talus_angle = angle;
    parameters.max_passes = 20000;
    const TerrainResult result = run(thermal, ground, parameters);
    EXPECT_LT(steepest_step(result.field.height, ground.cell), static_cast<double>(angle) + 0.51);
    const Grid<float> slope = slope_map(result.field);
    for (int j = 1; j < slope.height() - 1; ++j)
      for (int i = 1; i < slope.width() - 1; ++i) ASSERT_LT(slope(i, j), angle + 0.6F);
    expect_balanced(result, {"ground"});
  }
}

TEST(Thermal, ScreeRestsOnMountains) {
  for (const int resolution : {257, 513}) {
    const Heightfield ground = mountains(resolution, 4000);
    const TerrainResult result = run(thermal, ground, Thermal{});
    EXPECT_LT(steepest_loose(result.field, result.maps.at("sediment")), 33.51) << resolution;
    EXPECT_GT(steepest_step(result.field.height, ground.cell), 45);
    expect_balanced(result, {"ground"});
  }
}

TEST(Thermal, LooseMaterialRestsAfterAnyNumberOfPasses) {
  for (const int passes : {1, 20})
    for (const float cliff : {0.0F, 40.0F, 90.0F}) {
      Thermal parameters;
      parameters.talus_angle = 25;
      parameters.cliff_angle = cliff;
      parameters.loose_depth = 3;
      parameters.max_passes = passes;
      parameters.ladder = passes > 1;
      const Heightfield ground = mountains(97);
      const TerrainResult result = run(thermal, ground, parameters);
      if (cliff > 0) {
        EXPECT_LT(steepest_loose(result.field, result.maps.at("sediment")), 25.51) << cliff;
      } else {
        EXPECT_LT(steepest_step(result.field.height, ground.cell), 25.51);
      }
      expect_balanced(result, {"ground"});
    }
}

TEST(Thermal, CliffsBreakAndScreeLiesAtTheirFeet) {
  const Heightfield step = field_of(161, 9, 2, {}, [](DVec2 p) { return p.x < 159 ? 100 : 0; });
  Thermal parameters;
  parameters.max_passes = 50000;
  const TerrainResult result = run(thermal, step, parameters);
  const Grid<float>& wear = result.maps.at("wear");
  const Grid<float>& scree = result.maps.at("sediment");
  expect_balanced(result, {"ground"});
  // What broke off lies elsewhere.
  EXPECT_GT(volume(wear, 2), 1000);
  EXPECT_NEAR(volume(wear, 2), volume(scree, 2), 1e-3 * volume(wear, 2));
  for (int i = 0; i < 159; ++i) {
    const double drop =
        static_cast<double>(result.field.height(i, 4)) - result.field.height(i + 1, 4);
    EXPECT_LT(degrees(std::atan(drop / 2)), 50.6) << i;
    if (scree(i, 4) > 0.2F && scree(i + 1, 4) > 0.2F) {
      EXPECT_LT(degrees(std::atan(drop / 2)), 34) << i;
    }
  }
}

TEST(Thermal, OnlyTheLooseMovesWhereRockNeverBreaks) {
  const Heightfield ground = mountains(65);
  Thermal parameters;
  parameters.cliff_angle = 90;
  EXPECT_EQ(run(thermal, ground, parameters).field.height, ground.height);
  parameters.loose_depth = 2;
  const TerrainResult result = run(thermal, ground, parameters);
  expect_balanced(result, {"ground"});
  for (const float w : result.maps.at("wear").values()) EXPECT_EQ(w, 0);
  for (std::size_t k = 0; k < ground.height.size(); ++k)
    EXPECT_GE(result.field.height.values()[k], ground.height.values()[k] - 2.001F);
}

TEST(Thermal, HardGroundStays) {
  const Heightfield ground = mountains(65);
  Grid<float> hard(65, 65);
  for (int j = 0; j < 65; ++j)
    for (int i = 0; i < 65; ++i) hard(i, j) = i < 30 ? 1.0F : 0.0F;
  const std::map<std::string, Grid<float>> maps{{"hard", hard}};
  for (const bool inverted : {false, true}) {
    Thermal parameters = sand();
    parameters.hardness = "hard";
    parameters.hardness_invert = inverted;
    const TerrainResult result = run_with(thermal, ground, parameters, maps);
    float soft = 0;
    for (int j = 0; j < 65; ++j)
      for (int i = 0; i < 65; ++i) {
        const float wear = result.maps.at("wear")(i, j);
        if ((i < 30) != inverted) {
          EXPECT_EQ(wear, 0) << i << ' ' << j;
        } else {
          soft = std::max(soft, wear);
        }
      }
    EXPECT_GT(soft, 1);
  }
}

TEST(Thermal, TimeIsOfTheWorldNotOfTheGrid) {
  // A ridge too steep by little spreads as by diffusion: the same after the same years.
  const auto worn = [](int samples) {
    const double cell = 256.0 / (samples - 1);
    const Heightfield ridge = field_of(samples, 9, cell, {}, [](DVec2 p) {
      return 60 * std::exp(-std::pow((p.x - 128) / 30, 2));
    });
    Thermal parameters = sand();
    parameters.talus_angle = 20;
    parameters.years = 200;
    return height_at(run(thermal, ridge, parameters).field, {128, 4 * cell});
  };
  const float coarse = worn(65);
  EXPECT_LT(coarse, 59);
  EXPECT_NEAR(coarse, worn(129), 0.4);
  EXPECT_NEAR(worn(129), worn(257), 0.2);
}

TEST(Thermal, ResolutionsAgree) {
  const Heightfield coarse = run(thermal, mountains(65), Thermal{}).field;
  const Heightfield fine = run(thermal, mountains(129), Thermal{}).field;
  const HeightStatistics range = height_statistics(coarse);
  EXPECT_LT(rms_difference(coarse.height, fine.height),
            0.02 * static_cast<double>(range.max - range.min));
}

TEST(Thermal, SameBitsForAnyNumberOfThreads) {
  const Heightfield ground = mountains(150);
  Thermal parameters;
  parameters.max_passes = 60;
  expect_same_for_any_threads([&] { return run(thermal, ground, parameters); });
}

TEST(Thermal, AnyShapeWorks) {
  for (const auto& [w, h] : {std::pair{2, 5}, {5, 2}, {2, 2}, {3, 200}, {131, 35}}) {
    const Heightfield ground = field_of(w, h, 1, {}, [](DVec2 p) {
      return 30 * uniform(random_bits(1, static_cast<int>(p.x), static_cast<int>(p.y)));
    });
    for (const auto neighbours :
         {SlideNeighbours::four, SlideNeighbours::diagonals, SlideNeighbours::alternating})
      for (const float cliff : {0.0F, 50.0F}) {
        Thermal parameters;
        parameters.neighbours = neighbours;
        parameters.cliff_angle = cliff;
        const TerrainResult result = run(thermal, ground, parameters);
        EXPECT_LT(std::abs(result.balances[0].error()), 1e-3) << w << 'x' << h;
      }
  }
}

TEST(Thermal, CanBeCancelled) {
  const Heightfield ground = mountains(97);
  expect_stays_cancelled(thermal, ground, Thermal{});
}

TEST(Thermal, ErrorsNameTheParameter) {
  const Heightfield ground = mountains(17);
  Thermal parameters;
  parameters.talus_angle = 95;
  EXPECT_NE(error_text([&] { run(thermal, ground, parameters); }).find("talus_angle"),
            std::string::npos);
  Heightfield broken = ground;
  broken.height(3, 2) = NAN;
  EXPECT_NE(error_text([&] { run(thermal, broken, Thermal{}); }).find("(3, 2)"), std::string::npos);
  parameters = {};
  parameters.hardness = "nothing";
  EXPECT_NE(error_text([&] { run(thermal, ground, parameters); }, ErrorKind::io).find("nothing"),
            std::string::npos);
}

}  // namespace
}  // namespace wold
