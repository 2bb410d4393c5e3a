// Steps on samples of their own distance, maps that steps pass on, sums of what they moved, and
// steps on ground that is there already.

#include "terrain/step_cell.hpp"

#include "terrain/analysis.hpp"
#include "terrain/step_mask.hpp"
#include "testing.hpp"

namespace wold {
namespace {

using namespace testing_terrain;

/// Halves the ground, and remembers the samples that it saw.
struct Halve {};
Description<Halve> describe(const Halve&) {
  return Description<Halve>("halve", "Halves the ground.");
}
TerrainResult halve(const Heightfield& input, const Halve&, const TerrainContext&) {
  TerrainResult result{input, {}};
  for (float& h : result.field.height.values()) h /= 2;
  result.maps["seen"] =
      Grid<float>(input.height.width(), input.height.height(), static_cast<float>(input.cell));
  const double sum = 0.5 * input.cell;
  result.balances.push_back({"ground", 2 * sum, 0, sum, sum, sum});
  return result;
}

const TerrainSettings small{.size = 1000, .resolution = 101};

OperatorList operators() {
  OperatorList list = terrain_operators();
  list.push_back(terrain_operator(halve, {.maps = {"seen"}}));
  return list;
}

TerrainResult evaluated(const std::vector<TerrainStep>& steps) {
  Progress progress;
  return evaluate(small, steps, operators(), 1, {}, progress);
}

TerrainStep step(const char* op, std::initializer_list<std::pair<const char*, Value>> values) {
  TerrainStep made = make_step(operators(), op);
  for (const auto& [name, value] : values) assign(made, name, value);
  return made;
}

TEST(StepCell, FieldHasTheSameCorners) {
  const Heightfield like{Grid<float>(101, 51), {-500, 20}, 10};
  const Heightfield coarse = field_with_cell(like, 40);
  EXPECT_EQ(coarse.height.width(), 26);
  EXPECT_EQ(coarse.height.height(), 14);  // 500 m are 12.5 cells of 40 m
  EXPECT_EQ(coarse.origin, like.origin);
  EXPECT_EQ(coarse.size().x, like.size().x);
}

TEST(StepCell, WorksOnItsOwnSamplesAndKeepsFineDetail) {
  const TerrainStep hills = step("fbm", {{"height", 100.0}, {"feature_size", 900.0}});
  const TerrainStep grain = step("fbm", {{"height", 8.0}, {"feature_size", 25.0}});
  const TerrainResult ground = evaluated({hills, grain});
  const TerrainResult result =
      evaluated({hills, grain, step("halve", {{"cell", 50.0}, {"name", std::string("half")}})});
  // The step saw samples 50 m apart …
  for (const float cell : result.maps.at("seen").values()) EXPECT_NEAR(cell, 50, 1e-3F);
  EXPECT_TRUE(result.maps.at("half.seen").same_shape(result.field.height));
  // … halved what they show, and left what they do not: the ground is half the hills and all the
  // grain.
  const TerrainResult only_hills = evaluated({hills});
  double error = 0;
  for (std::size_t k = 0; k < ground.field.height.size(); ++k) {
    const float expected =
        ground.field.height.values()[k] - 0.5F * only_hills.field.height.values()[k];
    error =
        std::max(error, static_cast<double>(std::abs(result.field.height.values()[k] - expected)));
  }
  EXPECT_LT(error, 4);
}

TEST(StepCell, OfZeroIsTheTerrainsOwn) {
  const TerrainStep hills = step("fbm", {{"height", 100.0}});
  const TerrainResult result = evaluated({hills, step("halve", {})});
  const TerrainResult whole = evaluated({hills});
  EXPECT_EQ(result.maps.at("seen")(3, 4), 10);
  EXPECT_EQ(result.field.height(50, 50), whole.field.height(50, 50) / 2);
}

/// The distance of the samples that a step with a cell of 5 m sees in a window on terrain whose own
/// samples are 10 m apart.
float cell_seen(const TerrainWindow& window) {
  const std::vector<TerrainStep> steps{step("fbm", {}), step("halve", {{"cell", 5.0}})};
  Progress progress;
  return evaluate(small, window, steps, operators(), 1, {}, progress).maps.at("seen")(3, 4);
}

TEST(StepCell, IsNeverFinerThanTheSamplesOfACoarserView) {
  EXPECT_EQ(cell_seen({DVec2(-2000), 40, 101, 101}), 40) << "the land around";
  EXPECT_EQ(cell_seen({DVec2(-500), 20, 51, 51}), 20) << "the terrain itself, coarser";
}

TEST(StepCell, MayBeFinerThanTheTerrainsSamples) {
  EXPECT_EQ(cell_seen(window_of(small)), 5);
  EXPECT_EQ(cell_seen({DVec2(-300), 10, 21, 21}), 5) << "a part of it";
  EXPECT_EQ(cell_seen({DVec2(-1500), 10, 301, 21}), 5) << "more than it";
}

TEST(StepCell, TooFineACellIsRefusedWithItsSize) {
  const std::string text = error_text(
      [] {
        evaluated({step("fbm", {}), step("halve", {{"cell", 1e-4}})});
      },
      ErrorKind::limit);
  EXPECT_NE(text.find("'halve' with a cell of 0.0001 m works on"), std::string::npos) << text;
}

TEST(TerrainSteps, SumsOfWhatMovedCarryTheNameOfTheirStep) {
  const TerrainResult result =
      evaluated({step("halve", {}), step("halve", {{"name", std::string("second")}})});
  ASSERT_EQ(result.balances.size(), 2U);
  EXPECT_EQ(result.balances[0].step, "halve");
  EXPECT_EQ(result.balances[1].step, "second");
  EXPECT_EQ(result.balances[1].error(), 0);
}

TEST(TerrainSteps, OnGroundThatIsThere) {
  const Heightfield ground = field_of(31, 21, 10, {100, 200}, [](DVec2 p) { return 0.5 * p.x; });
  Progress progress;
  const std::vector<TerrainStep> steps{step("halve", {})};
  const TerrainResult result = evaluate_on(ground, steps, operators(), 1, {}, progress);
  EXPECT_EQ(result.field.origin, ground.origin);
  EXPECT_EQ(result.field.height(30, 7), ground.height(30, 7) / 2);
}

TEST(TerrainMaps, BecomeMasksOverARangeOfTheirValues) {
  const std::vector<TerrainStep> slope{step("plane", {{"height", 500.0}, {"slope", 20.0}}),
                                       step("mask", {{"name", std::string("high")},
                                                     {"from", std::string("height")},
                                                     {"height", std::vector{500.0, 1e5}},
                                                     {"height_feather", 200.0}}),
                                       step("mask", {{"name", std::string("upper")},
                                                     {"from", std::string("map")},
                                                     {"map", std::string("high")},
                                                     {"map_range", std::vector{0.5, 1.0}}}),
                                       step("mask", {{"name", std::string("both")},
                                                     {"from", std::string("slope")},
                                                     {"slope", std::vector{0.0, 90.0}},
                                                     {"times", std::string("high")}})};
  const TerrainResult result = evaluated(slope);
  const Grid<float>& high = result.maps.at("high");
  for (std::size_t k = 0; k < high.size(); ++k) {
    EXPECT_NEAR(result.maps.at("upper").values()[k],
                std::clamp(2 * high.values()[k] - 1, 0.0F, 1.0F), 1e-5F);
    EXPECT_EQ(result.maps.at("both").values()[k], high.values()[k]);
  }
}

TEST(TerrainMaps, LogarithmicMasksMeasureMagnitudes) {
  const TerrainResult result = evaluated(
      {step("constant", {{"height", 100.0}}), step("halve", {{"name", std::string("half")}}),
       step("mask", {{"name", std::string("m")},
                     {"from", std::string("map")},
                     {"map", std::string("half.seen")},  // 10 everywhere
                     {"map_range", std::vector{1.0, 1000.0}},
                     {"logarithmic", true}})});
  EXPECT_NEAR(result.maps.at("m")(5, 5), 1.0F / 3, 1e-5F);
}

TEST(TerrainMaps, RaiseTheGround) {
  const TerrainResult result = evaluated(
      {step("constant", {{"height", 100.0}}), step("halve", {{"name", std::string("half")}}),
       step("add_map", {{"map", std::string("half.seen")}, {"factor", 2.0}})});
  EXPECT_EQ(result.field.height(9, 9), 50 + 2 * 10);
}

TEST(TerrainMaps, UnknownOnesAreNamed) {
  const std::string text = error_text([] {
    evaluated({step("add_map", {{"map", std::string("flaw")}})});
  });
  EXPECT_NE(text.find("map 'flaw' is neither a map or step before this one nor a picture"),
            std::string::npos)
      << text;
  EXPECT_EQ(error_text([] { evaluated({step("add_map", {})}); }), "'add_map' needs a 'map'");
}

}  // namespace
}  // namespace wold
