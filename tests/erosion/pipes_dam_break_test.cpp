// Dams that break without friction: what the pipes make of it with momentum and without.

#include <gtest/gtest.h>

#include <numeric>

#include "erosion/pipes.hpp"
#include "water_testing.hpp"

namespace wold {
namespace {

using namespace testing_water;

constexpr double gravity = 9.81;
constexpr double deep = 2;      // m
constexpr double way = 400;     // m, on each side of the dam
constexpr double seconds = 30;  // from the break
const double wave = std::sqrt(gravity * deep);

enum class Way { east, west, north };

/// Depths along the way of the water, 30 s after the break of a dam in the middle.
std::vector<double> after_break(double cell, double depth_beyond, bool momentum,
                                Way direction = Way::east) {
  const int half = static_cast<int>(way / cell);
  const int n = 2 * half;
  const bool north = direction == Way::north;
  const int width = north ? 3 : n;
  const int height = north ? n : 3;
  const Heightfield flat = field_of(width, height, cell, {0, 0}, [](DVec2) { return 10; });
  const auto place = [&](int k) { return direction == Way::west ? n - 1 - k : k; };
  Grid<float> water(width, height);
  for (int k = 0; k < n; ++k)
    for (int side = 0; side < 3; ++side)
      (north ? water(side, k) : water(place(k), side)) =
          static_cast<float>(k < half ? deep : depth_beyond);
  Pipes p;
  p.water = "dam";
  p.rain = p.capacity = p.drag = 0;
  p.lakes = false;
  p.border = WaterBorder::closed;
  p.start_cell = 0.001F;
  p.top_speed = 20;
  p.momentum = momentum;
  p.duration = static_cast<float>(seconds / 3600);
  const Grid<float> after = run_with(pipes, flat, p, {{"dam", water}}).maps.at("water");
  std::vector<double> out;
  for (int k = 0; k < n; ++k)
    out.push_back(static_cast<double>(north ? after(1, k) : after(place(k), 1)));
  return out;
}

/// Ritter (1892): h = (2 c - x / t)² / 9 g between -c t and 2 c t, c = sqrt(g d).
double ritter(double x) {
  const double speed = std::clamp(x / seconds, -wave, 2 * wave);
  return std::pow(2 * wave - speed, 2) / (9 * gravity);
}

double place_of(std::size_t k, double cell) {
  return (static_cast<double>(k) + 0.5) * cell - way;
}

/// Mean error over the wave, of the depth of the lake.
double error_of(const std::vector<double>& depth, double cell) {
  double sum = 0;
  for (std::size_t k = 0; k < depth.size(); ++k)
    sum += std::abs(depth[k] - ritter(place_of(k, cell))) * cell;
  return sum / (3 * wave * seconds * deep);
}

double at_dam(const std::vector<double>& depth) {
  return 0.5 * (depth[depth.size() / 2 - 1] + depth[depth.size() / 2]);
}

/// How far water has come that is deeper than `least`, m.
double front_of(const std::vector<double>& depth, double cell, double least) {
  std::size_t k = depth.size() - 1;
  while (depth[k] < least) --k;
  return place_of(k, cell);
}

double beyond_dam(const std::vector<double>& depth, double cell) {
  return cell * std::accumulate(depth.begin() + static_cast<std::ptrdiff_t>(depth.size() / 2),
                                depth.end(), 0.0);
}

TEST(DamBreak, FollowsRitterWithMomentum) {
  const std::vector<double> depth = after_break(1, 0, true);
  EXPECT_LT(error_of(depth, 1), 0.006);
  EXPECT_NEAR(at_dam(depth), 4.0 / 9 * deep, 0.01 * deep);
  const double let_through = 8.0 / 27 * wave * deep * seconds;
  EXPECT_NEAR(beyond_dam(depth, 1), let_through, 0.02 * let_through);
  const double front = (2 * wave - 3 * std::sqrt(gravity * 0.01 * deep)) * seconds;
  EXPECT_NEAR(front_of(depth, 1, 0.01 * deep), front, 0.08 * front);
}

TEST(DamBreak, ComesNearerToRitterOnFinerCells) {
  const double coarse = error_of(after_break(2, 0, true), 2);
  const double fine = error_of(after_break(0.5, 0, true), 0.5);
  EXPECT_LT(fine, 0.5 * coarse);
}

TEST(DamBreak, IsTheSameInEveryDirection) {
  for (const bool momentum : {true, false}) {
    const std::vector<double> east = after_break(4, 0, momentum, Way::east);
    EXPECT_EQ(east, after_break(4, 0, momentum, Way::west));
    EXPECT_EQ(east, after_break(4, 0, momentum, Way::north));
  }
}

// Stoker (1957), over water of 0.2 m: between the wave back and a bore the depth is h and the speed
// 2 (c - sqrt(g h)) = (h - d') sqrt(g/2 (1/h + 1/d')); for 2 m and 0.2 m, 0.7923 m and 3.283 m/s.
// The bore runs at h u / (h - d').
TEST(DamBreak, FollowsStokerOverWater) {
  const std::vector<double> depth = after_break(1, 0.2, true);
  const double bore = 0.7923 * 3.2829 / (0.7923 - 0.2) * seconds;
  EXPECT_NEAR(front_of(depth, 1, 0.4), bore, 0.01 * bore);
  for (const std::size_t x : {60U, 90U, 120U}) EXPECT_NEAR(depth[400 + x], 0.7923, 0.01);
}

// Without momentum the wave runs back at its speed, but the front comes as a slow, steep bore.
TEST(DamBreak, IsSlowerWithoutMomentum) {
  const std::vector<double> depth = after_break(1, 0, false);
  double back = -way;
  for (std::size_t k = 0; depth[k] > 0.98 * deep; ++k) back = place_of(k, 1);
  EXPECT_NEAR(-back, wave * seconds, 0.05 * wave * seconds);
  EXPECT_NEAR(at_dam(depth), 0.54 * deep, 0.04 * deep);
  EXPECT_NEAR(front_of(depth, 1, 0.001), 0.8 * wave * seconds, 0.1 * wave * seconds);
}

}  // namespace
}  // namespace wold
