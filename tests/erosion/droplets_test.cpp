#include "erosion/droplets.hpp"

#include <algorithm>

#include "base/hash.hpp"
#include "image/io.hpp"
#include "terrain/analysis.hpp"
#include "terrain/fbm.hpp"
#include "terrain/resample.hpp"
#include "testing.hpp"

namespace wold {
namespace {

using namespace testing_erosion;

/// Hills over 1 km.
Heightfield hills(int samples, std::uint64_t seed = 5) {
  const Heightfield plane{Grid<float>(samples, samples), DVec2(-500), 1000.0 / (samples - 1)};
  return run(fbm, plane, FbmGround{.shape = {.height = 250, .feature_size = 600}}, seed);
}

/// Red in the west, blue in the east.
void write_halves(const std::string& path) {
  Grid<Vec3> picture(64, 64);
  for (int j = 0; j < 64; ++j)
    for (int i = 0; i < 64; ++i) picture(i, j) = i < 32 ? Vec3(1, 0, 0) : Vec3(0, 0, 1);
  write_exr(path, image_of(picture));
}

TEST(Droplets, KeepsTheMass) {
  const TerrainResult result = run(droplets, hills(129), Droplets{});
  expect_balanced(result, {"ground"});
  EXPECT_GT(result.balances.front().removed, 0);
}

TEST(Droplets, ClosedBorderKeepsEverythingInside) {
  Droplets p;
  p.closed_border = true;
  const TerrainResult result = run(droplets, hills(129), p);
  expect_balanced(result, {"ground"});
  EXPECT_EQ(result.balances.front().removed, 0);
}

TEST(Droplets, MomentumKeepsTheMassToo) {
  Droplets p;
  p.variant = DropletVariant::momentum;
  expect_balanced(run(droplets, hills(129), p), {"ground"});
}

TEST(Droplets, WearLessSedimentIsTheChange) {
  const Heightfield input = hills(129);
  const TerrainResult result = run(droplets, input, Droplets{});
  const auto wear = result.maps.at("wear").values();
  const auto sediment = result.maps.at("sediment").values();
  double worn = 0;
  for (std::size_t k = 0; k < wear.size(); ++k) {
    const float change = result.field.height.values()[k] - input.height.values()[k];
    ASSERT_NEAR(sediment[k] - wear[k], change, 1e-4);
    ASSERT_GE(sediment[k], 0);
    ASSERT_GT(wear[k], -1e-3F);
    worn += static_cast<double>(wear[k]);
  }
  const double moved = result.balances.front().moved;
  EXPECT_GT(worn * input.cell * input.cell, 0.999 * moved) << "banks slide besides";
  EXPECT_LT(worn * input.cell * input.cell, 1.3 * moved);
}

TEST(Droplets, FlatGroundStaysFlat) {
  const Heightfield flat = field_of(50, 40, 4, DVec2(0), [](DVec2) { return 123.25; });
  const TerrainResult result = run(droplets, flat, Droplets{});
  EXPECT_EQ(result.field.height, flat.height);
}

TEST(Droplets, SameBitsForAnyThreads) {
  const Heightfield input = hills(193);
  const std::map<std::string, Grid<float>> maps{{"hard", Grid<float>(193, 193, 0.3F)}};
  Droplets p;
  p.rain = 0.06F;
  const TemporaryFolder folder;
  write_halves(folder.file("halves.exr"));
  p.color = {"halves.exr"};
  p.hardness = "hard";
  expect_same_for_any_threads([&] { return run_with(droplets, input, p, maps, folder.path()); });
}

TEST(Droplets, OtherSeedsRainElsewhere) {
  const Heightfield input = hills(65);
  EXPECT_NE(run(droplets, input, Droplets{}, 1).field.height,
            run(droplets, input, Droplets{}, 2).field.height);
}

// Root of the mean square of a - b.
double rms(const Grid<float>& a, const Grid<float>& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    const double d = static_cast<double>(a.values()[k]) - static_cast<double>(b.values()[k]);
    sum += d * d;
  }
  return std::sqrt(sum / static_cast<double>(a.size()));
}

TEST(Droplets, ResolutionsAgree) {
  const Heightfield coarse = hills(97);
  const Grid<float> eroded = run(droplets, coarse, Droplets{}).field.height;
  const double change = rms(eroded, coarse.height);
  const HeightStatistics range = height_statistics(coarse);
  const double relief = rms(coarse.height, Grid<float>(97, 97, static_cast<float>(range.mean)));
  Progress progress;
  const TerrainDomain place{coarse.origin, coarse.size()};
  for (const int samples : {193, 385}) {
    const Heightfield fine = run(droplets, hills(samples), Droplets{}).field;
    const Grid<float> brought = resample(fine.height, place, Outside::clamp, coarse, progress);
    EXPECT_LT(rms(brought, eroded), 0.05 * relief) << samples;
    EXPECT_LT(rms(brought, eroded), 0.8 * change) << samples;
  }
}

TEST(Droplets, MeanWearDoesNotDependOnResolution) {
  const double coarse = run(droplets, hills(129), Droplets{}).balances.front().moved;
  const double fine = run(droplets, hills(257), Droplets{}).balances.front().moved;
  EXPECT_NEAR(fine / coarse, 1, 0.25);
}

TEST(Droplets, NoSpikesAndNoPits) {
  const Heightfield input = hills(257);
  const Heightfield output = run(droplets, input, Droplets{}).field;
  // The bend of a gully between stable banks is 2 tan 45° per cell; a needle's would be far more.
  const Grid<float> curvature = curvature_map(output);
  for (const float c : curvature.values())
    ASSERT_LT(std::abs(c) * static_cast<float>(input.cell), 3.2F);
}

TEST(Droplets, BanksOfGulliesAreStable) {
  const Heightfield input = field_of(129, 129, 4, DVec2(0), [](DVec2 p) {
    return -0.5 * p.x + 4 * std::sin(p.x * 0.031) * std::sin(p.y * 0.07);
  });
  const auto steepest = [&](float bank_slope) {
    Droplets p;
    p.capacity = 20;
    p.radius = 0;
    p.bank_slope = bank_slope;
    const Grid<float> slope = slope_map(run(droplets, input, p).field);
    return *std::max_element(slope.values().begin(), slope.values().end());
  };
  EXPECT_GT(steepest(90), 65);
  EXPECT_LT(steepest(35), 55);
}

TEST(Droplets, WhiteIsHard) {
  const Heightfield input = hills(65);
  const std::map<std::string, Grid<float>> maps{{"white", Grid<float>(65, 65, 1)},
                                                {"black", Grid<float>(65, 65, 0)}};
  Droplets p;
  p.hardness = "white";
  EXPECT_EQ(run_with(droplets, input, p, maps).field.height, input.height);
  p.hardness = "black";
  EXPECT_EQ(run_with(droplets, input, p, maps).field.height,
            run(droplets, input, Droplets{}).field.height);
  p.hardness_invert = true;
  EXPECT_EQ(run_with(droplets, input, p, maps).field.height, input.height);
}

TEST(Droplets, HardGroundIsNotLowered) {
  const Heightfield input = hills(129);
  Grid<float> half(129, 129);
  for (int j = 0; j < 129; ++j)
    for (int i = 0; i < 129; ++i) half(i, j) = i < 64 ? 1.0F : 0.0F;
  Droplets p;
  p.hardness = "half";
  const TerrainResult result = run_with(droplets, input, p, {{"half", half}});
  expect_balanced(result, {"ground"});
  for (int j = 0; j < 129; ++j)
    for (int i = 0; i < 64; ++i)
      ASSERT_GE(result.field.height(i, j), input.height(i, j)) << i << ", " << j;
}

TEST(Droplets, ItRainsWhereTheMapIsWhite) {
  const Heightfield input = hills(65);
  Droplets p;
  p.rain_map = "none";
  EXPECT_EQ(run_with(droplets, input, p, {{"none", Grid<float>(65, 65, 0)}}).field.height,
            input.height);
  p = {};
  p.rain = 0;
  EXPECT_EQ(run(droplets, input, p).field.height, input.height);
}

TEST(Droplets, AnyShapeWorks) {
  for (const IVec2 size : {IVec2(2, 5), IVec2(5, 2), IVec2(2, 2), IVec2(33, 70), IVec2(130, 7)}) {
    const Heightfield input = field_of(size.x, size.y, 10, DVec2(-7, 3), [](DVec2 p) {
      return 30 * std::sin(p.x * 0.05) + 20 * std::cos(p.y * 0.07) - 0.3 * p.x;
    });
    for (const bool closed : {false, true}) {
      Droplets p;
      p.closed_border = closed;
      const TerrainResult result = run(droplets, input, p);
      EXPECT_TRUE(result.field.height.same_shape(input.height));
      // Very little moves: what remains is the rounding of one height to a float.
      const Balance& ground = result.balances.front();
      EXPECT_LE(std::abs(ground.error()), 1e-6 * ground.moved + 4e-6 * 100);
    }
  }
}

TEST(Droplets, ColorGoesWithTheGround) {
  const TemporaryFolder folder;
  write_halves(folder.file("halves.exr"));
  const Heightfield input = field_of(65, 65, 10, DVec2(0), [](DVec2 p) {
    return 300 * std::exp(-p.x / 200) + 3 * std::sin(p.y * 0.05);
  });
  Droplets p;
  p.color = {"halves.exr"};
  p.color_depth = 0.05F;
  const TerrainResult result = run_with(droplets, input, p, {}, folder.path());
  const Grid<float>& red = result.maps.at("color.red");
  const Grid<float>& green = result.maps.at("color.green");
  const Grid<float>& blue = result.maps.at("color.blue");
  EXPECT_GT(red(50, 32), 0.1F);
  EXPECT_LT(blue(10, 32), 0.02F);
  for (std::size_t k = 0; k < red.size(); ++k) {
    EXPECT_NEAR(red.values()[k] + blue.values()[k], 1, 0.01);
    EXPECT_NEAR(green.values()[k], 0, 0.01);
  }
  EXPECT_EQ(result.field.height, run(droplets, input, Droplets{}).field.height)
      << "colours do not change the ground";
}

TEST(Droplets, FlowIsWhereDropsGather) {
  // A valley along x = 500 m that falls to the north.
  const Heightfield input = field_of(101, 101, 10, DVec2(0),
                                     [](DVec2 p) { return 0.3 * std::abs(p.x - 500) - 0.1 * p.y; });
  const TerrainResult result = run(droplets, input, Droplets{});
  const Grid<float>& flow = result.maps.at("flow");
  const Grid<float>& discharge = result.maps.at("discharge");
  for (const float f : flow.values()) ASSERT_TRUE(f >= 0 && f <= 1);
  float valley = 0;
  float side = 0;
  for (int i = 46; i <= 54; ++i) valley += discharge(i, 80);
  for (int i = 16; i <= 24; ++i) side += discharge(i, 80);
  EXPECT_GT(valley, 3 * side);
}

TEST(Droplets, CanBeCancelled) {
  expect_stays_cancelled(droplets, hills(129), Droplets{});
}

TEST(Droplets, ErrorsNameWhatIsWrong) {
  Heightfield input = hills(33);
  Droplets p;
  p.erosion = -1;
  EXPECT_NE(error_text([&] { run(droplets, input, p); }).find("erosion"), std::string::npos);
  p = {};
  p.rain = std::numeric_limits<float>::quiet_NaN();
  EXPECT_NE(error_text([&] { run(droplets, input, p); }).find("rain"), std::string::npos);
  p = {};
  p.hardness = "nothing";
  EXPECT_NE(error_text([&] { run_with(droplets, input, p, {}); }, ErrorKind::io).find("nothing"),
            std::string::npos);
  input.height(3, 4) = std::numeric_limits<float>::infinity();
  EXPECT_NE(error_text([&] { run(droplets, input, Droplets{}); }).find("(3, 4)"),
            std::string::npos);
}

}  // namespace
}  // namespace wold
