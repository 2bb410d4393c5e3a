#include "erosion/drainage.hpp"

#include "drainage_testing.hpp"
#include "erosion/drainage_area.hpp"
#include "erosion/drainage_depressions.hpp"
#include "erosion/drainage_network.hpp"

namespace wold {
namespace {

using namespace testing_erosion;

struct Routed {
  explicit Routed(const Grid<float>& height, double cell = 1)
      : direction(d8_directions(height, progress)),
        order(direction, progress),
        area(d8_area(direction, order, cell)) {}

  Progress progress;
  Grid<std::uint8_t> direction;
  FlowOrder order;
  Grid<double> area;
};

/// Σ of what ends at samples without a lower neighbour.
double ending_area(const Grid<float>& height, const Grid<double>& area) {
  const Routed routed(height);
  double sum = 0;
  for (std::size_t k = 0; k < area.size(); ++k)
    if (routed.direction.values()[k] >= flow_stops) sum += area.values()[k];
  return sum;
}

Grid<float> filled(const Grid<float>& height, FillSurface surface) {
  Progress progress;
  return fill_depressions(height, surface, progress);
}

// A bowl of rim 9 that spills at 5: 8 samples of 4 and one of 1 are raised to 5.
const Grid<float> bowl =
    ground({{9, 9, 9, 9, 9}, {9, 4, 4, 4, 9}, {9, 4, 1, 4, 5}, {9, 4, 4, 4, 9}, {9, 9, 9, 9, 9}});

// Between walls of 9, from the west: an outlet at 4, a hollow, a sill of 6, a basin with two
// hollows and a sill of 3 within, a saddle at 8, a hollow that spills eastwards at 7.
const Grid<float> chain =
    ground({{9, 9, 9, 9, 9, 9, 9, 9, 9}, {4, 2, 6, 1, 3, 0, 8, 5, 7}, {9, 9, 9, 9, 9, 9, 9, 9, 9}});

TEST(FillDepressions, RaisesABowlToItsSpill) {
  EXPECT_EQ(
      filled(bowl, FillSurface::level),
      ground(
          {{9, 9, 9, 9, 9}, {9, 5, 5, 5, 9}, {9, 5, 5, 5, 5}, {9, 5, 5, 5, 9}, {9, 9, 9, 9, 9}}));
}

TEST(FillDepressions, KnowsNestedDepressionsAndSaddles) {
  EXPECT_EQ(filled(chain, FillSurface::level), ground({{9, 9, 9, 9, 9, 9, 9, 9, 9},
                                                       {4, 4, 6, 6, 6, 6, 8, 7, 7},
                                                       {9, 9, 9, 9, 9, 9, 9, 9, 9}}));
}

TEST(FillDepressions, SlopingLeavesNeitherPitsNorFlats) {
  for (const Grid<float>& h : {bowl, chain, Grid<float>(40, 30, 7.0F), rough(150, 90, 5).height,
                               Grid<float>(2, 5, 1.0F)}) {
    const Grid<float> sloping = filled(h, FillSurface::sloping);
    const Grid<float> level = filled(h, FillSurface::level);
    EXPECT_EQ(count_pits(sloping), 0);
    for (std::size_t k = 0; k < h.size(); ++k) {
      EXPECT_GE(level.values()[k], h.values()[k]);
      EXPECT_GE(sloping.values()[k], level.values()[k]);
      EXPECT_NEAR(sloping.values()[k], level.values()[k], 0.01);
    }
  }
}

TEST(FillDepressions, FlatGroundRisesByOneFloatPerSampleFromTheBorder) {
  const Grid<float> out = filled(Grid<float>(9, 7, 1.0F), FillSurface::sloping);
  for (int j = 0; j < 7; ++j)
    for (int i = 0; i < 9; ++i) {
      const int rings = std::min({i, j, 8 - i, 6 - j});
      EXPECT_EQ(out(i, j), 1 + static_cast<float>(rings) * 0x1p-23F);
    }
}

TEST(FindLakes, TellsLevelAreaVolumeAndDepth) {
  const Lakes found = find_lakes(chain, filled(chain, FillSurface::level), 10);
  ASSERT_EQ(found.lakes.size(), 3U);
  EXPECT_EQ(found.lakes[0].level, 4);
  EXPECT_EQ(found.lakes[0].volume, 200);  // one sample, 2 m
  EXPECT_EQ(found.lakes[1].level, 6);
  EXPECT_EQ(found.lakes[1].area, 300);
  EXPECT_EQ(found.lakes[1].volume, 1400);  // 5 + 3 + 6 m
  EXPECT_EQ(found.lakes[1].depth, 6);
  EXPECT_EQ(found.lakes[2].level, 7);
  EXPECT_EQ(found.label(4, 1), 2);
  EXPECT_EQ(found.label(6, 1), 0);
}

TEST(D8, LeadsAllOfABowlToItsSpill) {
  const Routed r(filled(bowl, FillSurface::sloping), 2);
  EXPECT_EQ(r.area(4, 2), 25 * 4.0);
  EXPECT_EQ(r.direction(4, 2), flow_leaves);
}

// The walls flow to the steepest of three filled samples below; the saddle's water goes west.
TEST(D8, DividesAChainOfDepressionsAtItsSaddle) {
  const Routed r(filled(chain, FillSurface::sloping));
  EXPECT_EQ(r.area(0, 1), 21);
  EXPECT_EQ(r.area(8, 1), 6);
  const Grid<std::int32_t> basins = basin_labels(r.direction, r.order);
  EXPECT_EQ(basins(6, 1), basins(0, 1));
  EXPECT_EQ(basins(7, 1), basins(8, 1));
  EXPECT_NE(basins(6, 1), basins(7, 1));
}

TEST(D8, WaterStaysInPitsThatAreLeft) {
  const Routed r(bowl);
  EXPECT_EQ(r.direction(2, 2), flow_stops);
  EXPECT_EQ(r.area(2, 2), 25);
}

// A valley along y whose sides are so steep that they flow straight to the axis.
TEST(D8, KnowsTheAreasOfAValley) {
  const Heightfield valley =
      field_of(21, 15, 3, {0, 0}, [](DVec2 p) { return 10 * std::abs(p.x - 30) + 0.5 * p.y; });
  const Routed r(valley.height, 3);
  for (int j = 0; j < 15; ++j) {
    EXPECT_EQ(r.area(10, j), 9.0 * 21 * (15 - j));
    for (int i = 0; i < 10; ++i) EXPECT_EQ(r.area(i, j), 9.0 * (i + 1));
  }
  EXPECT_FLOAT_EQ(downstream_length(r.direction, r.order, 3)(0, 14), 30 + 14 * 3);
  EXPECT_FLOAT_EQ(upstream_length(r.direction, r.order, 3)(10, 0), 30 + 14 * 3);
}

TEST(D8, EqualSlopesTakeTheFirstCounterClockwiseFromEast) {
  const Routed r(ground({{1, 0, 1}, {0, 1, 0}, {1, 0, 1}}));
  EXPECT_EQ(r.direction(1, 1), 0);
}

TEST(FlowOrder, VisitsEverySampleOnceAfterItsDonors) {
  const Heightfield field = rough(70, 300, 5);
  const Routed r(filled(field.height, FillSurface::sloping));
  Grid<int> visited(70, 300, 0);
  r.order.upstream_first([&](int k) {
    each_donor(r.direction, k,
               [&](int n) { EXPECT_EQ(visited.values()[static_cast<std::size_t>(n)], 1); });
    ++visited.values()[static_cast<std::size_t>(k)];
  });
  EXPECT_EQ(visited, Grid<int>(70, 300, 1));
  r.order.downstream_first([&](int k) {
    const int d = r.direction.values()[static_cast<std::size_t>(k)];
    if (d < flow_stops) {
      EXPECT_EQ(visited.values()[static_cast<std::size_t>(k + flow_step(d, 70))], 2);
    }
    ++visited.values()[static_cast<std::size_t>(k)];
  });
  EXPECT_EQ(visited, Grid<int>(70, 300, 2));
}

TEST(Drainage, AllAreaEndsSomewhere) {
  const Heightfield field = rough(130, 200, 4);
  const double all = 130 * 200 * 16.0;
  Progress progress;
  for (const Grid<float>& h : {field.height, filled(field.height, FillSurface::sloping)}) {
    EXPECT_EQ(ending_area(h, Routed(h, 4).area), all);
    EXPECT_NEAR(ending_area(h, d_infinity_area(h, 4, progress)), all, 1e-8 * all);
    EXPECT_NEAR(ending_area(h, multiple_flow_area(h, 4, 1.1, progress)), all, 1e-8 * all);
  }
}

// Down a plane all water of a column goes to the next, in whatever shares: away from the sides that
// lack donors every sample of column i has the area of i + 1.
TEST(DInfinity, IsExactOnAPlane) {
  for (const double across : {0.0, 0.3, 0.5, 0.9}) {
    const Heightfield plane =
        field_of(20, 40, 2, {0, 0}, [&](DVec2 p) { return 100 - p.x - across * p.y; });
    Progress progress;
    const Grid<float> direction = d_infinity_directions(plane.height, progress);
    const Grid<double> area = d_infinity_area(plane.height, 2, progress);
    for (int i = 1; i < 19; ++i)
      for (int j = i + 1; j < 39; ++j) {
        EXPECT_NEAR(area(i, j), 4.0 * (i + 1), 1e-3);
        EXPECT_NEAR(direction(i, j), std::atan(across) / (pi_d / 4), 1e-4);
      }
  }
}

TEST(MultipleFlow, PassesAllWaterDownAPlane) {
  const Heightfield plane = field_of(20, 60, 2, {0, 0}, [](DVec2 p) { return 100 - p.x; });
  Progress progress;
  const Grid<double> area = multiple_flow_area(plane.height, 2, 1.1, progress);
  for (int i = 0; i < 20; ++i) {
    double column = 0;
    for (int j = 0; j < 60; ++j) column += area(i, j);
    EXPECT_NEAR(column, 4.0 * 60 * (i + 1), 1e-6);
    EXPECT_NEAR(area(i, 30), 4.0 * (i + 1), 1e-6);
  }
}

// Only the middle has lower neighbours: falls of 3 to the east, 1 over √2 to the north-east, 2 to
// the south.
TEST(MultipleFlow, DividesByThePowerOfSlope) {
  const Grid<float> h = ground({{5, 5, 4}, {5, 5, 2}, {5, 3, 5}});
  Progress progress;
  const double p = 1.1;
  const Grid<double> area = multiple_flow_area(h, 1, p, progress);
  const double sum = std::pow(3, p) + std::pow(1 / std::sqrt(2.0), p) + std::pow(2, p);
  EXPECT_EQ(area(1, 1), 1);
  // The south: itself; the west, the south-west (their only lower neighbour, of theirs the south
  // is one of those), the south-east's share by its falls 3 north, 2 west; and the middle's.
  const double south_east = std::pow(2, p) / (std::pow(2, p) + std::pow(3, p));
  EXPECT_NEAR(area(1, 0), 1 + 1 + 1 + south_east + std::pow(2, p) / sum, 1e-12);
}

// On a cone the specific area is r / 2 everywhere: Freeman reports deviations of a few per cent for
// p = 1.1, Tarboton a far smaller spread for D∞ than for D8.
TEST(Areas, OnAConeAreRounderThanD8) {
  const Heightfield cone =
      field_of(129, 129, 1, {-64, -64}, [](DVec2 p) { return 1000 - glm::length(p); });
  Progress progress;
  const auto spread = [](const Grid<double>& area) {
    double sum = 0;
    int count = 0;
    for (int j = 0; j < 129; ++j)
      for (int i = 0; i < 129; ++i) {
        const double r = std::hypot(i - 64, j - 64);
        if (r < 20 || r > 60) continue;
        const double relative = area(i, j) / (r / 2) - 1;
        sum += relative * relative;
        ++count;
      }
    return std::sqrt(sum / count);
  };
  const double d8 = spread(Routed(cone.height).area);
  const double d_infinity = spread(d_infinity_area(cone.height, 1, progress));
  const double multiple = spread(multiple_flow_area(cone.height, 1, 1.1, progress));
  EXPECT_GT(d8, 0.5);
  EXPECT_LT(d_infinity, 0.13);
  EXPECT_LT(multiple, 0.08);
}

TEST(Breach, DigsTheRimJustBelowThePit) {
  const Grid<float> h = ground({{9, 9, 9, 9, 9}, {0, 1, 5, 2, 9}, {9, 9, 9, 9, 9}});
  Progress progress;
  Grid<float> expected = h;
  expected(2, 1) = std::nextafter(2.0F, 0.0F);
  EXPECT_EQ(breach_depressions(h, 1, {3, 10}, progress), expected);
  EXPECT_EQ(breach_depressions(h, 1, {2.9, 10}, progress), h);
  EXPECT_EQ(breach_depressions(h, 1, {3, 1.9}, progress), h);
}

// Two ways out of the pit: 3 + 3 m through the north, 5 m through the west.
TEST(Breach, TakesTheWayWithTheLeastToDig) {
  const Grid<float> h =
      ground({{9, 9, 0, 9, 9}, {9, 9, 4, 9, 9}, {9, 9, 4, 9, 9}, {0, 6, 1, 9, 9}, {9, 9, 9, 9, 9}});
  Progress progress;
  const Grid<float> out = breach_depressions(h, 1, {10, 10}, progress);
  EXPECT_LT(out(1, 1), 1);
  EXPECT_EQ(out(2, 2), 4);
  EXPECT_EQ(out(2, 3), 4);
}

TEST(Strahler, JoinsOrders) {
  // Channels from both sides meet in the middle column; water goes south.
  const Heightfield valley =
      field_of(5, 6, 1, {0, 0}, [](DVec2 p) { return 10 * std::abs(p.x - 2) + 0.5 * p.y; });
  const Routed r(valley.height);
  const Grid<std::uint8_t> order = strahler_order(r.direction, r.order, r.area, 1);
  EXPECT_EQ(order(0, 3), 1);
  EXPECT_EQ(order(1, 3), 1);  // one donor of order 1
  EXPECT_EQ(order(2, 5), 2);  // two of order 1 meet
  EXPECT_EQ(order(2, 0), 2);  // 2 with 1 and 1 stays 2
  const Grid<std::uint8_t> rivers = strahler_order(r.direction, r.order, r.area, 3);
  EXPECT_EQ(rivers(1, 3), 0);
  EXPECT_EQ(rivers(2, 0), 1);
}

TEST(Drainage, NoPitsRemain) {
  const Heightfield field = rough(150, 120, 5);
  ASSERT_GT(count_pits(field.height), 20);
  for (const auto method : {DepressionMethod::fill, DepressionMethod::breach}) {
    const TerrainResult out = run(drainage, field, Drainage{.depressions = method});
    EXPECT_EQ(count_pits(out.field.height), 0);
    ASSERT_EQ(out.balances.size(), 1U);
    EXPECT_GT(out.balances[0].moved, 0);
    EXPECT_LT(std::abs(out.balances[0].relative_error()), 1e-9);
  }
}

TEST(Drainage, CanLeaveTheGround) {
  const Heightfield field = rough(60, 50, 5);
  const TerrainResult out = run(drainage, field, Drainage{.change_ground = false});
  EXPECT_EQ(out.field.height, field.height);
  EXPECT_EQ(out.balances[0].moved, 0);
  for (const char* map : {"area", "flow", "wetness", "lakes", "basins", "order"})
    EXPECT_TRUE(out.maps.at(map).same_shape(field.height)) << map;
  for (const float f : out.maps.at("flow").values()) EXPECT_TRUE(f > 0 && f < 1);
}

TEST(Drainage, IsTheSameForAnyNumberOfThreads) {
  const Heightfield field = rough(190, 300, 5);
  for (const auto flow : {FlowMethod::d8, FlowMethod::d_infinity, FlowMethod::multiple}) {
    expect_same_for_any_threads([&] { return run(drainage, field, Drainage{.flow = flow}); });
  }
}

TEST(Drainage, NarrowAndSmallGroundWorks) {
  for (const auto& [w, h] : {std::pair{2, 2}, {2, 5}, {5, 2}, {3, 3}, {2, 300}}) {
    const TerrainResult out = run(drainage, rough(w, h, 5), Drainage{});
    EXPECT_EQ(count_pits(out.field.height), 0);
  }
}

TEST(Drainage, CancelsAndNamesWrongParameters) {
  const Heightfield field = rough(60, 50, 5);
  EXPECT_NE(error_text([&] { run(drainage, field, Drainage{.exponent = -1}); }).find("exponent"),
            std::string::npos);
  expect_stays_cancelled(drainage, field, Drainage{});
}

}  // namespace
}  // namespace wold
