#include "terrain/operators.hpp"

#include "terrain/analysis.hpp"
#include "terrain/arithmetic.hpp"
#include "terrain/blur.hpp"
#include "terrain/combine.hpp"
#include "terrain/falloff.hpp"
#include "terrain/mask.hpp"
#include "terrain/plane.hpp"
#include "terrain/soft.hpp"
#include "terrain/terrace.hpp"
#include "terrain/warp.hpp"
#include "testing.hpp"

namespace wold {
namespace {

using testing_terrain::error_text;
using testing_terrain::field_of;
using testing_terrain::largest_difference;
using testing_terrain::run;
using testing_terrain::Steps;

const auto east = [](DVec2 p) { return p.x; };

TEST(TerrainOperators, PlaneFallsDownhill) {
  const Heightfield level = field_of(33, 33, 10, {-160, -160}, [](DVec2) { return 5; });
  const Heightfield tilted = run(plane, level, Plane{.height = 40, .slope = 20, .downhill = 90});
  EXPECT_NEAR(tilted.height(16, 16), 40, 1e-4);
  EXPECT_NEAR(tilted.height(32, 3), 40 - 160 * std::tan(radians(20.0)), 1e-3);
  const Grid<float> slopes = slope_map(tilted);
  for (const float s : slopes.values()) ASSERT_NEAR(s, 20, 1e-3);
}

TEST(TerrainOperators, ArithmeticBySample) {
  const Heightfield ramp = field_of(101, 2, 1, {0, 0}, east);
  EXPECT_EQ(run(scale, ramp, Scale{.factor = 2, .offset = -3}).height(10, 0), 17);
  const Heightfield turned = run(remap, ramp, Remap{.from = {0, 100}, .to = {50, -50}});
  EXPECT_EQ(turned.height(0, 0), 50);
  EXPECT_EQ(turned.height(100, 0), -50);
  const Heightfield held = run(clamp_heights, ramp, Clamp{.range = {20, 30}});
  EXPECT_EQ(held.height(3, 0), 20);
  EXPECT_EQ(held.height(25, 0), 25);
  EXPECT_EQ(held.height(90, 0), 30);
  const Heightfield bent = run(power, ramp, Power{.range = {0, 100}, .exponent = 2});
  EXPECT_NEAR(bent.height(50, 0), 25, 1e-4);
  EXPECT_NEAR(bent.height(100, 0), 100, 1e-4);
}

TEST(TerrainOperators, RangesMustNotBeEmpty) {
  const Heightfield ramp = field_of(3, 3, 1, {0, 0}, east);
  EXPECT_EQ(error_text([&] {
              run(remap, ramp, Remap{.from = {5, 5}});
            }),
            "the two heights in 'from' of 'remap' must differ");
  EXPECT_EQ(error_text([&] {
              run(power, ramp, Power{.range = {5, 5}});
            }),
            "the two heights in 'range' of 'power' must differ");
}

TEST(TerrainOperators, SmoothFloorRoundsOnlyItsBanks) {
  const Heightfield ramp = field_of(201, 2, 1, {-100, 0}, east);
  const Heightfield floor = run(smooth_floor, ramp, SmoothFloor{.level = 0, .softness = 40});
  EXPECT_EQ(floor.height(50, 0), 0);
  EXPECT_EQ(floor.height(150, 0), 50);
  EXPECT_NEAR(floor.height(100, 0), 10, 1e-5);  // a quarter of the softness
  for (int i = 1; i < 201; ++i) ASSERT_GE(floor.height(i, 0), floor.height(i - 1, 0));
}

TEST(TerrainOperators, SoftMaximumAndMinimum) {
  EXPECT_EQ(soft_max(3, 10, 5), 10);
  EXPECT_EQ(soft_max(3, 3, 0), 3);
  EXPECT_FLOAT_EQ(soft_max(3, 3, 4), 4);
  EXPECT_FLOAT_EQ(soft_min(3, 3, 4), 2);
  EXPECT_EQ(soft_step(5, 0, 5), 1);
  EXPECT_EQ(soft_step(5, 2, 5), 0.5F);
}

TEST(TerrainOperators, TerracesAreLevelAndMeetTheGroundAtEachStep) {
  const Heightfield ramp = field_of(401, 2, 1, {-200, 0}, east);
  const Terrace parameters{.spacing = 50, .flat = 0.5F, .strength = 1, .variation = 0};
  const Heightfield steps = run(terrace, ramp, parameters);
  for (int i = 0; i < 401; ++i) {
    const float h = ramp.height(i, 0);
    const float layer = std::floor(h / 50) * 50;
    if (h - layer <= 25)
      ASSERT_NEAR(steps.height(i, 0), layer, 1e-4) << h;
    else
      ASSERT_GT(steps.height(i, 0), layer) << h;
    ASSERT_LE(steps.height(i, 0), layer + 50);
    if (h - layer == 49) {
      ASSERT_GT(steps.height(i, 0), layer + 49.5F);
    }
  }
}

TEST(TerrainOperators, BlurredGaussianIsAWiderGaussian) {
  const double a = 30;
  const double b = 40;
  const auto gaussian = [](double deviation) {
    return [deviation](DVec2 p) {
      const double v = deviation * deviation;
      return 1000 / v * std::exp(-0.5 * glm::dot(p, p) / v);
    };
  };
  const Heightfield narrow = field_of(161, 161, 5, {-400, -400}, gaussian(a));
  const Heightfield wide = field_of(161, 161, 5, {-400, -400}, gaussian(std::hypot(a, b)));
  const Heightfield made = run(blur, narrow, Blur{.distance = static_cast<float>(b)});
  EXPECT_LT(largest_difference(made.height, wide.height), 1e-3 * wide.height(80, 80));
}

TEST(TerrainOperators, BlurKeepsTheSumOfAnImpulseAndIsEvenOnAllSides) {
  Heightfield impulse = field_of(41, 41, 1, {0, 0}, [](DVec2) { return 0; });
  impulse.height(20, 20) = 1;
  const Grid<float> made = run(blur, impulse, Blur{.distance = 2.5}).height;
  double sum = 0;
  for (const float h : made.values()) sum += h;
  EXPECT_NEAR(sum, 1, 1e-5);
  EXPECT_EQ(made(23, 20), made(17, 20));
  EXPECT_FLOAT_EQ(made(20, 24), made(24, 20));
}

TEST(TerrainOperators, BlurLeavesAPlaneAndNothingChangesWithoutDistance) {
  const Heightfield ramp = field_of(65, 65, 1, {0, 0}, east);
  EXPECT_NEAR(run(blur, ramp, Blur{.distance = 4}).height(32, 32), 32, 1e-4);
  EXPECT_EQ(run(blur, ramp, Blur{.distance = 0}).height, ramp.height);
}

// cos of whole half-waves is its own mirror image at both borders, so every sample of it, those on
// the border too, loses exp(-k² σ² / 2); wide Gaussians reach over more than one image.
TEST(Blur, MirroredWavesOnlyFade) {
  const double wave = pi / 12;
  const Heightfield waves = field_of(13, 25, 1, {0, 0}, [&](DVec2 p) {
    return 100 * std::cos(wave * p.x) * std::cos(wave * p.y);
  });
  Progress progress;
  for (const double deviation : {1.0, 3.0, 6.0}) {
    const Grid<float> out = blurred(waves.height, deviation, progress, Outside::mirror);
    const double left = std::exp(-wave * wave * deviation * deviation);
    for (int j = 0; j < 25; ++j)
      for (int i = 0; i < 13; ++i)
        ASSERT_NEAR(out(i, j), left * static_cast<double>(waves.height(i, j)), 0.02)
            << i << ' ' << j << ' ' << deviation;
  }
}

TEST(TerrainOperators, WarpMovesByAtMostItsDistance) {
  const Heightfield ramp = field_of(129, 129, 10, {0, 0}, east);
  const Heightfield moved = run(warp, ramp, Warp{.distance = 60, .feature_size = 200});
  float largest = 0;
  for (int j = 10; j < 119; ++j)
    for (int i = 10; i < 119; ++i)
      largest = std::max(largest, std::abs(moved.height(i, j) - ramp.height(i, j)));
  EXPECT_LE(largest, 60.01F);
  EXPECT_GT(largest, 30);
}

TEST(TerrainOperators, CombineJoinsTwoSteps) {
  const auto height = [](const char* method, double other) {
    Steps steps;
    steps.add("constant", {{"height", other}, {"name", std::string("other")}})
        .add("constant", {{"height", 10.0}, {"blend", std::string("replace")}})
        .add("combine", {{"with", std::string("other")},
                         {"method", std::string(method)},
                         {"softness", 8.0},
                         {"amount", 0.25}});
    return steps.evaluate({.size = 10, .resolution = 3}).field.height(1, 1);
  };
  EXPECT_EQ(height("add", 4), 14);
  EXPECT_EQ(height("subtract", 4), 6);
  EXPECT_EQ(height("multiply", 4), 40);
  EXPECT_EQ(height("max", 4), 10);
  EXPECT_EQ(height("min", 4), 4);
  EXPECT_EQ(height("smooth_max", 10), 12);
  EXPECT_EQ(height("smooth_min", 10), 8);
  EXPECT_EQ(height("mix", 4), 8.5);
}

TEST(TerrainOperators, FalloffKeepsTheMiddleAndLevelsTheEdge) {
  const Heightfield high = field_of(101, 101, 10, {-500, -500}, [](DVec2) { return 100; });
  for (const FalloffShape shape : {FalloffShape::round, FalloffShape::square}) {
    const Heightfield island =
        run(falloff, high, Falloff{.shape = shape, .width = 200, .level = -20, .irregularity = 50});
    EXPECT_EQ(island.height(50, 50), 100);
    for (int k = 0; k < 101; ++k) {
      ASSERT_EQ(island.height(k, 0), -20);
      ASSERT_EQ(island.height(100, k), -20);
    }
  }
}

TEST(TerrainOperators, NoiseMasksCoverTheirPart) {
  const Heightfield level = field_of(257, 257, 20, {0, 0}, [](DVec2) { return 0; });
  for (const float coverage : {0.2F, 0.5F, 0.8F}) {
    const TerrainResult result =
        run(make_mask, level,
            Mask{.from = MaskSource::noise, .feature_size = 300, .coverage = coverage});
    double sum = 0;
    for (const float m : result.maps.at("mask").values()) sum += m;
    EXPECT_NEAR(sum / (257 * 257), coverage, 0.06);
    EXPECT_EQ(result.field.height, level.height);
  }
}

TEST(TerrainOperators, CrestsAndHollowsAreMasked) {
  const auto dome = [](DVec2 p) { return std::sqrt(200 * 200 - glm::dot(p, p)); };
  const Heightfield field = field_of(21, 21, 2, {-20, -20}, dome);
  const Mask crests{.from = MaskSource::crests, .curvature_radius = 200};
  const Mask hollows{.from = MaskSource::hollows, .curvature_radius = 200};
  EXPECT_NEAR(run(make_mask, field, crests).maps.at("mask")(10, 10), 1, 0.01);
  EXPECT_EQ(run(make_mask, field, hollows).maps.at("mask")(10, 10), 0);
}

TEST(TerrainOperators, NamesAreUnique) {
  std::map<std::string, int> names;
  for (const TerrainOperator& op : terrain_operators()) EXPECT_EQ(names[op.name()]++, 0);
  EXPECT_EQ(names.size(), 21U);
}

}  // namespace
}  // namespace wold
