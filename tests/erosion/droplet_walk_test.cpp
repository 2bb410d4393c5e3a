// One drop on an inclined plane, step by step against the equations of droplets.hpp.

#include "erosion/droplet_walk.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "erosion/droplet_ground.hpp"
#include "erosion/droplet_rates.hpp"

namespace wold {
namespace {

constexpr int width = 64;
constexpr int height = 16;
constexpr int stride = droplet_stride(width);
constexpr double cell = 2;
constexpr double slope = 0.25;  // downhill to the east
constexpr float start_x = 3.5F;
constexpr int start_y = 8;

Heightfield plane() {
  Heightfield field{Grid<float>(width, height), DVec2(0), cell};
  for (int j = 0; j < height; ++j)
    for (int i = 0; i < width; ++i) field.height(i, j) = static_cast<float>(100 - slope * cell * i);
  return field;
}

/// What a single drop leaves behind.
struct Walk {
  explicit Walk(const Droplets& parameters, DropletColors* colors = nullptr)
      : field(plane()), ground(field), passes(static_cast<std::size_t>(stride * height)) {
    const DropletRates rates = droplet_rates(parameters, cell, ground.quantum());
    DropletWorld world;
    world.width = width;
    world.height = height;
    world.stride = stride;
    world.cells = ground.cells();
    world.passes = passes.data();
    world.colors = colors;
    Drop drop;
    drop.cell = {static_cast<int>(start_x), start_y};
    drop.fraction = {start_x - std::floor(start_x), 0};
    drop.direction = {0, 1};
    drop.left = rates.steps;
    const Progress progress;
    walk_droplets(world, rates, {0, 0, width, height}, {drop}, tally, progress);
  }

  std::size_t sample(int i, int j) const {
    return static_cast<std::size_t>(j) * stride + static_cast<std::size_t>(i);
  }
  /// m³ that the ground gained.
  double gained() {
    double sum = 0;
    for (int j = 0; j < height; ++j)
      for (int i = 0; i < width; ++i)
        sum += ground.cells()[sample(i, j)].height - ground.quantised(field.height(i, j));
    return sum * ground.quantum() * cell * cell;
  }
  double removed() const {
    return static_cast<double>(tally.removed) * ground.quantum() * cell * cell;
  }

  Heightfield field;
  DropletGround ground;
  std::vector<DropletPasses> passes;
  DropletTally tally;
};

Droplets frictionless() {
  Droplets p;
  p.scatter = 0;
  p.drag = 0;
  p.evaporation = 0;
  p.max_speed = 1000;
  p.distance = 10000;
  return p;
}

/// `ahead`: cells by which the speed is ahead of the place.
void expect_falls_freely(const Droplets& parameters, int ahead = 0) {
  Walk walk(parameters);
  EXPECT_EQ(walk.tally.finished, 1);
  for (int i = 4; i < width; ++i) {
    EXPECT_EQ(walk.passes[walk.sample(i, start_y)].count, 1U) << i;
    const double fallen = slope * cell * (i - 4 + ahead);
    const float v =
        static_cast<float>(walk.passes[walk.sample(i, start_y)].speed) * droplet_speed_unit;
    EXPECT_NEAR(v, std::sqrt(2 * 9.81 * fallen), droplet_speed_unit + 1e-4) << i;
  }
  const std::uint32_t all =
      std::accumulate(walk.passes.begin(), walk.passes.end(), 0U,
                      [](std::uint32_t n, const DropletPasses& p) { return n + p.count; });
  EXPECT_EQ(all, static_cast<std::uint32_t>(width - 4)) << "straight down";
}

TEST(DropletWalk, DropFallsFreelyDownAPlane) {
  Droplets p = frictionless();
  p.erosion = 0;
  expect_falls_freely(p);
}

TEST(DropletWalk, MomentumGivesTheSameSpeed) {
  Droplets p = frictionless();
  p.variant = DropletVariant::momentum;
  p.erosion = 0;
  expect_falls_freely(p, 1);
}

TEST(DropletWalk, DragLimitsTheSpeed) {
  Droplets p = frictionless();
  p.erosion = 0;
  p.drag = 0.2F;
  Walk walk(p);
  // v² = v² e^(-2 k L) + 2 g S L
  const double limit = 2 * 9.81 * slope * cell / (1 - std::exp(-2 * 0.2 * cell));
  const float v = static_cast<float>(walk.passes[walk.sample(width - 3, start_y)].speed);
  EXPECT_NEAR(v * droplet_speed_unit, std::sqrt(limit), 0.02);
}

TEST(DropletWalk, DropTakesUpWhatItCanCarry) {
  Droplets p = frictionless();
  p.capacity = 1.5F;
  p.erosion = 0.02F;
  p.deposition = 0.02F;
  p.evaporation = 0.01F;
  Walk walk(p);
  // By hand: the drop is at x = 3.5 + k. Of what it takes at one place, half at each of two
  // samples, a quarter is found one cell further, where its next fall begins.
  double v2 = 0;
  double sediment = 0;
  double water = 1;
  double taken_before = 0;  // m³
  double worn = 0;
  for (int k = 1; k <= width - 5; ++k) {
    const double fall = slope * cell - 0.25 * taken_before / (cell * cell);
    const double could = 1.5 * (fall / cell) * std::sqrt(v2) * water;
    taken_before = (could - sediment) * (1 - std::exp(-0.02 * cell));
    sediment += taken_before;  // negative where water becomes scarce
    worn += std::max(0.0, taken_before);
    v2 += 2 * 9.81 * fall;
    water *= std::exp(-0.01 * cell);
  }
  ASSERT_GT(sediment, 0.5);
  EXPECT_NEAR(walk.removed(), sediment, 1e-4 * sediment);
  EXPECT_DOUBLE_EQ(walk.gained() + walk.removed(), 0);
  EXPECT_NEAR(walk.ground.total_wear() * cell * cell, worn, 1e-4 * worn);
}

TEST(DropletWalk, DropLaysDownNoHigherThanItCameFrom) {
  Droplets p = frictionless();
  p.capacity = 100;
  p.erosion = 0.5F;
  p.deposition = 100;
  p.evaporation = 0.2F;
  Walk walk(p);
  EXPECT_DOUBLE_EQ(walk.gained() + walk.removed(), 0);
  const auto h = [&](int i) { return walk.ground.cells()[walk.sample(i, start_y)].height; };
  for (int i = 1; i < width; ++i) EXPECT_LE(h(i), h(i - 1)) << "a dam at " << i;
}

TEST(DropletWalk, ColorsAreTakenAsTheGroundIs) {
  Droplets p = frictionless();
  p.deposition = 0;
  DropletColors colors;  // red in the west, blue in the east
  for (int k = 0; k < stride * height; ++k)
    colors.skin.push_back(k % stride < width / 2 ? Vec3(1, 0, 0) : Vec3(0, 0, 1));
  colors.beneath = colors.skin;
  colors.depth = 10;  // quanta: more is taken at once
  Walk walk(p, &colors);
  double red = 0;
  double blue = 0;
  for (int k = 0; k < stride * height; ++k)
    (k % stride < width / 2 ? red : blue) += walk.ground.cells()[k].wear;
  ASSERT_GT(red, 1000);
  EXPECT_NEAR(static_cast<double>(walk.tally.color_removed.r), red, 1e-4 * (red + blue));
  EXPECT_NEAR(static_cast<double>(walk.tally.color_removed.b), blue, 1e-4 * (red + blue));
  EXPECT_EQ(walk.tally.color_removed.g, 0);
}

TEST(DropletWalk, WithoutCapacityNothingIsTaken) {
  Droplets p = frictionless();
  p.capacity = 0;
  Walk walk(p);
  EXPECT_EQ(walk.gained(), 0);
  EXPECT_EQ(walk.tally.removed, 0);
}

}  // namespace
}  // namespace wold
