#include "erosion/stream_power.hpp"

#include "drainage_testing.hpp"
#include "erosion/flow_routing_pits.hpp"
#include "erosion/stream_power_levels.hpp"
#include "erosion/stream_power_solver.hpp"
#include "terrain/fbm.hpp"

namespace wold {
namespace {

using namespace testing_erosion;

std::size_t at(int k) {
  return static_cast<std::size_t>(k);
}

/// Ground that uplift and streams have shaped for so long that nothing changes any more.
struct Steady {
  Steady(double m, double n, double erodibility) : size(64), cell(100), height(size, size) {
    for (int j = 0; j < size; ++j)
      for (int i = 0; i < size; ++i) height(i, j) = uniform_height(i, j);
    Progress progress;
    StreamPowerSolver solver(cell, {.area_exponent = m, .slope_exponent = n, .wandering = 0},
                             {Grid<float>(size, size, static_cast<float>(erodibility)),
                              Grid<float>(size, size, 1e-3F),
                              Grid<float>(size, size, 1e4F),
                              {}},
                             StreamPowerMesh({height, {0, 0}, cell}, 1, false), 1, progress);
    for (int s = 0; s < 400; ++s) solver.step(height, s < 200 ? 1e5 : 1e6);
    direction = solver.direction();
    area = solver.area();
  }

  static float uniform_height(int i, int j) {
    return static_cast<float>((i * 7919 + j * 104729) % 1009) / 1009;
  }
  double slope(int k) const {
    const int d = direction.values()[at(k)];
    return (static_cast<double>(height.values()[at(k)]) -
            static_cast<double>(height.values()[at(k + flow_step(d, size))])) /
           (cell * flow_distance(d));
  }

  int size;
  double cell;
  Grid<float> height;
  Grid<std::uint8_t> direction;
  Grid<float> area;
};

// S = (U/K)^(1/n) A^(-m/n) at every sample, and the fitted concavity is m/n.
TEST(StreamPowerSolver, RiversSettleAtTheirSteadySlope) {
  struct Case {
    double m, n, erodibility;
  };
  for (const Case& c :
       {Case{0.5, 1, 1e-5}, Case{0.45, 1, 2e-5}, Case{0.6, 1.5, 1e-6}, Case{0.3, 0.7, 1e-4}}) {
    const Steady steady(c.m, c.n, c.erodibility);
    double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
    for (int k = 0; k < steady.size * steady.size; ++k) {
      if (steady.direction.values()[at(k)] >= flow_stops) continue;
      const double area = static_cast<double>(steady.area.values()[at(k)]);
      const double expected = std::pow(1e-3 / c.erodibility, 1 / c.n) * std::pow(area, -c.m / c.n);
      EXPECT_NEAR(steady.slope(k), expected, 0.01 * expected);
      const double x = std::log(area);
      const double y = std::log(steady.slope(k));
      n += 1, sx += x, sy += y, sxx += x * x, sxy += x * y;
    }
    const double concavity = -(n * sxy - sx * sy) / (n * sxx - sx * sx);
    EXPECT_NEAR(concavity, c.m / c.n, 0.002 * c.m / c.n);
  }
}

// Where streams lay down as much of their load as G says, they must cut 1 + G times as fast to keep
// up with the uplift: S = (1 + G) U/K A^-m for n = 1. At every sample but the ends of ridges, where
// slopes hang on the last step's receivers.
TEST(StreamPowerSolver, DepositionSteepensRiversByOnePlusItsShare) {
  constexpr double share = 0.7;
  constexpr double uplift = 1e-3;
  constexpr double erodibility = 1e-5;
  Steady land(0.5, 1, erodibility);
  Progress progress;
  StreamPowerSolver solver(
      land.cell, {.area_exponent = 0.5, .slope_exponent = 1, .deposition = share, .wandering = 0},
      {Grid<float>(land.size, land.size, static_cast<float>(erodibility)),
       Grid<float>(land.size, land.size, static_cast<float>(uplift)),
       Grid<float>(land.size, land.size, 1e4F),
       {}},
      StreamPowerMesh({land.height, {0, 0}, land.cell}, 1, false), 1, progress);
  for (int s = 0; s < 1200; ++s) solver.step(land.height, 2000);
  land.direction = solver.direction();
  land.area = solver.area();
  std::vector<double> ratios;
  for (int k = 0; k < land.size * land.size; ++k) {
    if (land.direction.values()[at(k)] >= flow_stops) continue;
    const double plain =
        uplift / erodibility / std::sqrt(static_cast<double>(land.area.values()[at(k)]));
    ratios.push_back(land.slope(k) / plain);
  }
  std::sort(ratios.begin(), ratios.end());
  EXPECT_NEAR(ratios[ratios.size() / 2], 1 + share, 0.01);
  EXPECT_NEAR(ratios[ratios.size() / 20], 1 + share, 0.1);
  EXPECT_NEAR(ratios[ratios.size() - 1 - ratios.size() / 20], 1 + share, 0.1);
}

TEST(StreamPowerSolver, NoSlopeAlongWaterIsSteeperThanTalus) {
  const int size = 50;
  Grid<float> height = rough(size, size, 20, 800, 400).height;
  Progress progress;
  StreamPowerSolver solver(20, {},
                           {Grid<float>(size, size, 1e-6F),
                            Grid<float>(size, size, 0),
                            Grid<float>(size, size, 0.6F),
                            {}},
                           StreamPowerMesh({height, {0, 0}, 20}, 1, false), 1, progress);
  for (int s = 0; s < 60; ++s) solver.step(height, 1000);
  for (int j = 1; j < size - 1; ++j)
    for (int i = 1; i < size - 1; ++i) {
      const int d = solver.direction()(i, j);
      const float fall = height(i, j) - height.values()[at(j * size + i + flow_step(d, size))];
      EXPECT_LE(static_cast<double>(fall), 0.6001 * 20 * flow_distance(d));
    }
}

// From the bowl of the tests of drainage: the pit's water goes out over the spill at 5.
TEST(PitRouter, LeadsAPitOverItsSpill) {
  const Grid<float> bowl =
      ground({{9, 9, 9, 9, 9}, {9, 4, 4, 4, 9}, {9, 4, 1, 4, 5}, {9, 4, 4, 4, 9}, {9, 9, 9, 9, 9}});
  Progress progress;
  Grid<std::uint8_t> direction = d8_directions(bowl, progress);
  ASSERT_EQ(direction(2, 2), flow_stops);
  ASSERT_EQ(direction(4, 2), 4);  // even the spill's own water goes in
  PitRouter router;
  EXPECT_EQ(router.route(bowl, direction, all_sides, progress), 1);
  const FlowOrder order(direction, progress);
  EXPECT_EQ(d8_area(direction, order, 1)(4, 2), 25);
}

TEST(PitRouter, LeavesNoPitAndNoCycleOnRoughGround) {
  const Heightfield field = rough(150, 290, 5);
  Progress progress;
  Grid<std::uint8_t> direction = d8_directions(field.height, progress);
  PitRouter router;
  EXPECT_GT(router.route(field.height, direction, all_sides, progress), 100);
  const Grid<double> area = d8_area(direction, FlowOrder(direction, progress), 1);
  double out = 0;
  for (std::size_t k = 0; k < area.size(); ++k) {
    EXPECT_NE(direction.values()[k], flow_stops);
    if (direction.values()[k] == flow_leaves) out += area.values()[k];
  }
  EXPECT_EQ(out, 150.0 * 290.0);
}

// Water from every sample crosses no pass higher than it must: that of the filled ground.
TEST(PitRouter, SpillsOverTheLowestPasses) {
  const Heightfield field = rough(90, 70, 5);
  Progress progress;
  Grid<std::uint8_t> direction = d8_directions(field.height, progress);
  PitRouter().route(field.height, direction, all_sides, progress);
  const Grid<float> filled = testing_erosion::filled_level(field.height);
  Grid<float> highest = field.height;
  FlowOrder(direction, progress).downstream_first([&](int k) {
    const int d = direction.values()[at(k)];
    if (d < flow_stops)
      highest.values()[at(k)] =
          std::max(highest.values()[at(k)], highest.values()[at(k + flow_step(d, 90))]);
  });
  EXPECT_EQ(highest, filled);
}

Heightfield small_range(int count, double cell) {
  return field_of(count, count, cell, {0, 0}, [](DVec2 p) {
    return 100 + 30 * std::sin(p.x / 700) * std::cos(p.y / 900 + 1) + 20 * std::sin(p.y / 300);
  });
}

TEST(StreamPower, RaisesAndCutsAndAnswersForIt) {
  const Heightfield input = small_range(97, 60);
  const TerrainResult out = run(stream_power, input, StreamPower{.years = 1e6F});
  const Balance& b = out.balances.at(0);
  EXPECT_EQ(b.quantity, "ground");
  EXPECT_NEAR(b.added, 1000.0 * 97 * 97 * 3600, 1e-6 * b.added);
  EXPECT_GT(b.removed, 0.2 * b.added);
  EXPECT_LT(std::abs(b.relative_error()), 1e-6);
  for (const char* map : {"area", "flow", "wear", "sediment", "uplift"})
    EXPECT_TRUE(out.maps.at(map).same_shape(input.height)) << map;
}

/// The middle of hills, of `cells` cells a side on 8 km, that were computed with a margin of some
/// more, as steps that look at their surroundings want it.
Grid<float> range_within_margin(int cells, int margin, std::uint64_t seed) {
  const TerrainDomain domain{{0, 0}, {8000, 8000}};
  const double cell = domain.size.x / cells;
  const int samples = cells + 1 + 2 * margin;
  const Heightfield flat{Grid<float>(samples, samples), DVec2(-margin * cell), cell};
  Progress progress;
  const std::map<std::string, TerrainResult> none;
  const TerrainContext context{seed, domain, {}, none, progress};
  const Heightfield hills =
      fbm(flat, FbmGround{.shape = {.height = 150, .base = 0, .feature_size = 3000}, .hurst = 0.9F},
          context);
  const Grid<float> high = stream_power(hills, StreamPower{.years = 1e6F}, context).field.height;
  Grid<float> out(cells + 1, cells + 1);
  for (int j = 0; j <= cells; ++j)
    for (int i = 0; i <= cells; ++i) out(i, j) = high(i + margin, j + margin);
  return out;
}

// Now and then a difference of a centimetre sends a river over another pass: so the median of some
// lands.
TEST(StreamPower, DoesNotDependOnResolutionOrMargin) {
  std::vector<double> differences;
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const Grid<float> coarse = range_within_margin(256, 2, seed);
    const Grid<float> fine = range_within_margin(512, 9, seed);
    const auto [low, high] = std::minmax_element(coarse.values().begin(), coarse.values().end());
    differences.push_back(rms_difference(coarse, fine) / static_cast<double>(*high - *low));
  }
  std::sort(differences.begin(), differences.end());
  EXPECT_LT(differences[1], 0.02);
  EXPECT_LT(differences[2], 0.04);
}

TEST(StreamPowerLevels, LieWhereTheyLieWhateverTheResolution) {
  const TerrainDomain domain{{-500, 300}, {6400, 4800}};
  const auto levels_of = [&](double cell, int margin) {
    const DVec2 origin = domain.origin - DVec2(margin * cell);
    const int width = static_cast<int>(domain.size.x / cell) + 1 + 2 * margin;
    const int height = static_cast<int>(domain.size.y / cell) + 1 + 2 * margin;
    const Heightfield land = field_of(width, height, cell, origin, [](DVec2 p) {
      return 80 * std::sin(p.x / 900) * std::cos(p.y / 700);
    });
    Progress progress;
    return stream_power_levels(land, domain, 1000, 1, progress);
  };
  const auto coarse = levels_of(25, 0);
  const auto fine = levels_of(12.5, 5);
  ASSERT_EQ(coarse.size(), 3U);
  ASSERT_EQ(fine.size(), 4U);
  for (std::size_t l = 0; l + 1 < coarse.size(); ++l) {
    EXPECT_EQ(coarse[l].ground.origin, domain.origin);
    EXPECT_EQ(coarse[l].ground.cell, 100 / std::exp2(l));
    EXPECT_EQ(coarse[l].ground.origin, fine[l].ground.origin);
    EXPECT_EQ(coarse[l].ground.cell, fine[l].ground.cell);
    EXPECT_LT(largest_difference(coarse[l].ground.height, fine[l].ground.height), 0.1);
  }
}

TEST(StreamPowerLevels, StripsBetweenTheLinesOfTheLatticeAreGroundToo) {
  const TerrainDomain domain{{0, 0}, {1000, 1000}};
  Progress progress;
  for (const double south : {-400.0, 508.0, 2000.0}) {
    const Heightfield strip = field_of(201, 2, 5, {0, south}, [](DVec2 p) { return p.x + p.y; });
    for (const StreamPowerLevel& level : stream_power_levels(strip, domain, 1000, 1, progress)) {
      ASSERT_GE(level.ground.height.height(), 2);
      for (const float h : level.ground.height.values()) ASSERT_TRUE(std::isfinite(h));
    }
  }
}

TEST(StreamPower, IsTheSameForAnyNumberOfThreads) {
  expect_same_for_any_threads(
      [] { return run(stream_power, rough(200, 300, 10), StreamPower{.years = 1e5F}); });
}

TEST(StreamPower, ClosedSidesHoldNoOutlet) {
  const TerrainResult out =
      run(stream_power, small_range(65, 60),
          StreamPower{.years = 2e5F, .diffusivity = 0, .open = OpenSides::south});
  const Grid<float>& h = out.field.height;
  // The far side has been raised; along the open one outlets keep their heights.
  EXPECT_GT(h(32, 64), small_range(65, 60).height(32, 64) + 50);
  float lowest_change = 1e9F;
  for (int i = 0; i < 65; ++i)
    lowest_change = std::min(lowest_change, h(i, 0) - small_range(65, 60).height(i, 0));
  EXPECT_LT(lowest_change, 1);
}

TEST(StreamPower, HardRockDoesNotErodeByStreams) {
  const Heightfield input = small_range(65, 60);
  const std::map<std::string, Grid<float>> maps{{"rock", Grid<float>(65, 65, 1)},
                                                {"dry", Grid<float>(65, 65, 0)}};
  const auto removed = [&](const StreamPower& p) {
    return run_with(stream_power, input, p, maps).balances.at(0).removed;
  };
  StreamPower p{.years = 1e5F, .diffusivity = 0, .talus = 85};
  p.hardness = "rock";
  const double hard = removed(p);
  p.hardness = "";
  p.rain = "dry";
  const double dry = removed(p);
  p.rain = "";
  const double soft = removed(p);
  EXPECT_LT(hard, 0.1 * soft);
  EXPECT_LT(dry, 0.1 * soft);
}

TEST(StreamPower, SmallGroundCancelAndErrors) {
  for (const auto& [w, h] : {std::pair{2, 2}, {2, 5}, {5, 2}, {3, 40}}) {
    const TerrainResult out = run(stream_power, rough(w, h, 5), StreamPower{});
    for (const float z : out.field.height.values()) EXPECT_TRUE(std::isfinite(z));
  }
  const Heightfield field = rough(20, 20, 5);
  EXPECT_NE(error_text([&] { run(stream_power, field, StreamPower{.talus = 90}); }).find("talus"),
            std::string::npos);
  expect_stays_cancelled(stream_power, field, StreamPower{});
}

}  // namespace
}  // namespace wold
