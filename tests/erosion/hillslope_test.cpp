#include "erosion/hillslope.hpp"

#include "drainage_testing.hpp"

namespace wold {
namespace {

using namespace testing_erosion;

/// A Gaussian of variance `variance` m² that holds 1e6 m³, on a plane at 100 m.
double hill(DVec2 p, double variance) {
  return 100 + 1e6 / (2 * pi_d * variance) * std::exp(-glm::dot(p, p) / (2 * variance));
}

Heightfield hill_field(double variance, double cell = 8, int count = 101) {
  const double half = cell * (count - 1) / 2;
  return field_of(count, count, cell, {-half, -half}, [&](DVec2 p) { return hill(p, variance); });
}

TEST(Hillslope, AGaussianSpreadsByTwoKappaT) {
  const Heightfield out =
      run(hillslope, hill_field(3000), Hillslope{.years = 1e5F, .diffusivity = 0.01F})
          .field;  // variance 3000 + 2 · 0.01 · 1e5 = 5000
  const double top = hill({0, 0}, 5000) - 100;
  for (int j = 0; j < 101; ++j)
    for (int i = 0; i < 101; ++i)
      EXPECT_NEAR(out.height(i, j), hill(8.0 * DVec2(i - 50, j - 50), 5000), 0.01 * top);
}

TEST(Hillslope, AClosedBorderKeepsAllGround) {
  for (const float critical : {0.0F, 40.0F}) {
    const TerrainResult out =
        run(hillslope, rough(70, 50, 10), Hillslope{.critical_slope = critical});
    const Balance& b = out.balances.at(0);
    EXPECT_EQ(b.removed, 0);
    EXPECT_GT(b.moved, 0);
    EXPECT_LT(std::abs(b.relative_error()), 1e-6);
  }
}

TEST(Hillslope, AnOpenBorderKeepsItsHeights) {
  const Heightfield input = rough(30, 40, 10);
  for (const float critical : {0.0F, 40.0F}) {
    const TerrainResult out = run(
        hillslope, input, Hillslope{.critical_slope = critical, .border = HillslopeBorder::open});
    for (int i = 0; i < 30; ++i) EXPECT_EQ(out.field.height(i, 39), input.height(i, 39));
    for (int j = 0; j < 40; ++j) EXPECT_EQ(out.field.height(0, j), input.height(0, j));
    EXPECT_LT(std::abs(out.balances.at(0).relative_error()), 1e-6);
  }
}

// As much soil comes as goes, whatever the critical slope.
TEST(Hillslope, APlaneStays) {
  const Heightfield plane = field_of(30, 20, 5, {0, 0}, [](DVec2 p) { return 0.6 * p.x; });
  const TerrainResult out =
      run(hillslope, plane,
          Hillslope{.years = 1e5F, .critical_slope = 45, .border = HillslopeBorder::open});
  EXPECT_LT(largest_difference(out.field.height, plane.height), 1e-3F);
}

// The hill is up to 0.59 steep: 31°.
TEST(Hillslope, SteepSlopesRunOffFasterWithACriticalSlope) {
  const auto moved = [](float critical) {
    return run(hillslope, hill_field(3000), Hillslope{.critical_slope = critical})
        .balances.at(0)
        .moved;
  };
  EXPECT_GT(moved(40), 1.3 * moved(0));
  EXPECT_NEAR(moved(85), moved(0), 0.02 * moved(0));
}

TEST(Hillslope, DoesNotDependOnResolution) {
  const auto out = [](double cell, int count) {
    return run(hillslope, hill_field(3000, cell, count),
               Hillslope{.years = 1e5F, .diffusivity = 0.01F})
        .field.height;
  };
  EXPECT_LT(rms_difference(out(16, 51), out(8, 101)), 0.005 * (hill({0, 0}, 5000) - 100));
}

TEST(Hillslope, IsTheSameForAnyNumberOfThreads) {
  for (const float critical : {0.0F, 40.0F}) {
    expect_same_for_any_threads(
        [&] { return run(hillslope, rough(130, 90, 10), Hillslope{.critical_slope = critical}); });
  }
}

TEST(Hillslope, SmallGroundCancelAndErrors) {
  for (const auto& [w, h] : {std::pair{2, 2}, {2, 5}, {5, 2}})
    for (const float critical : {0.0F, 40.0F})
      EXPECT_LT(std::abs(run(hillslope, rough(w, h, 5), Hillslope{.critical_slope = critical})
                             .balances.at(0)
                             .relative_error()),
                1e-5);
  const Heightfield field = rough(20, 20, 5);
  EXPECT_NE(
      error_text([&] { run(hillslope, field, Hillslope{.diffusivity = -1}); }).find("diffusivity"),
      std::string::npos);
  expect_stays_cancelled(hillslope, field, Hillslope{});
}

}  // namespace
}  // namespace wold
