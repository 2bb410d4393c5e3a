#include "terrain/steps.hpp"

#include <fstream>

#include "base/parallel.hpp"
#include "terrain/analysis.hpp"
#include "testing.hpp"

namespace wold {
namespace {

using testing_terrain::error_text;
using testing_terrain::largest_difference;
using testing_terrain::Steps;
using testing_terrain::TemporaryFolder;

const TerrainSettings small{.size = 1024, .resolution = 129};

/// A landscape that uses most operators.
Steps landscape() {
  Steps steps;
  steps.add("ridged", {{"height", 400.0}, {"feature_size", 700.0}})
      .add("warp", {{"distance", 60.0}, {"feature_size", 300.0}})
      .add("fbm",
           {{"height", 100.0}, {"feature_size", 300.0}, {"mask_slope", std::vector{10.0, 90.0}}})
      .add("mask", {{"name", std::string("flats")}, {"slope", std::vector{0.0, 20.0}}})
      .add("blur", {{"distance", 20.0}, {"mask", std::string("flats")}})
      .add("terrace", {{"spacing", 40.0}});
  return steps;
}

TEST(TerrainSteps, NoStepsAreAPlaneAtZero) {
  const TerrainResult result = Steps().evaluate({});
  EXPECT_EQ(result.field.height.width(), 1025);
  EXPECT_EQ(result.field.size(), DVec2(4000));
  EXPECT_EQ(result.field.origin, DVec2(-2000));
  EXPECT_EQ(height_statistics(result.field).max, 0);
}

TEST(TerrainSteps, WindowOfARectangle) {
  const TerrainWindow window =
      window_of({.size = 2000, .size_north = 1000, .resolution = 201, .center = {500, -100}});
  EXPECT_EQ(window.width, 201);
  EXPECT_EQ(window.height, 101);
  EXPECT_EQ(window.cell, 10);
  EXPECT_EQ(window.origin, DVec2(-500, -600));
}

TEST(TerrainSteps, BlendsInMetres) {
  const auto height = [](const char* blend, double opacity) {
    Steps steps;
    steps.add("constant", {{"height", 100.0}});
    steps.add("constant", {{"height", 30.0}, {"blend", std::string(blend)}, {"opacity", opacity}});
    return steps.evaluate(small).field.height(5, 7);
  };
  EXPECT_EQ(height("automatic", 1), 130);
  EXPECT_EQ(height("replace", 1), 30);
  EXPECT_EQ(height("add", 1), 130);
  EXPECT_EQ(height("subtract", 1), 70);
  EXPECT_EQ(height("multiply", 1), 3000);
  EXPECT_EQ(height("max", 1), 100);
  EXPECT_EQ(height("min", 1), 30);
  EXPECT_EQ(height("replace", 0.25), 82.5);
  EXPECT_EQ(height("add", 0), 100);
}

TEST(TerrainSteps, InputNamesAnEarlierStep) {
  Steps steps;
  steps.add("constant", {{"height", 10.0}, {"name", std::string("ten")}})
      .add("constant", {{"height", 500.0}})
      .add("scale", {{"factor", 3.0}, {"input", std::string("ten")}});
  EXPECT_EQ(steps.evaluate(small).field.height(0, 0), 30);
}

TEST(TerrainSteps, DisabledStepsAreSkippedAndKeepTheOthersRandomNumbers) {
  Steps all;
  all.add("fbm").add("fbm");
  Steps second_only;
  second_only.add("fbm", {{"enabled", false}}).add("fbm");
  Steps first_only;
  first_only.add("fbm").add("fbm", {{"enabled", false}});
  const Grid<float> both = all.evaluate(small).field.height;
  const Grid<float> first = first_only.evaluate(small).field.height;
  const Grid<float> second = second_only.evaluate(small).field.height;
  for (int i = 0; i < 129; i += 16) EXPECT_NEAR(both(i, i), first(i, i) + second(i, i), 1e-3);
  EXPECT_GT(largest_difference(first, second), 50);
}

TEST(TerrainSteps, SeedsOfSceneAndStepMatter) {
  Steps a;
  a.add("fbm");
  Steps b;
  b.add("fbm", {{"seed", std::int64_t{1}}});
  EXPECT_GT(
      largest_difference(a.evaluate(small, 1).field.height, a.evaluate(small, 2).field.height), 50);
  EXPECT_GT(largest_difference(a.evaluate(small).field.height, b.evaluate(small).field.height), 50);
}

TEST(TerrainSteps, MasksByHeightSlopeAndMap) {
  Steps steps;
  steps
      .add("plane", {{"slope", 45.0}, {"downhill", 270.0}})  // rises to the east
      .add("mask", {{"name", std::string("high")},
                    {"from", std::string("height")},
                    {"height", std::vector{0.0, 1e5}},
                    {"height_feather", 0.0}})
      .add("constant", {{"height", 7.0}, {"mask", std::string("high")}})
      .add("constant", {{"height", 3.0}, {"mask", std::string("high")}, {"mask_invert", true}})
      .add("constant", {{"height", 1000.0}, {"mask_slope", std::vector{0.0, 20.0}}})
      .add("constant", {{"height", 50.0},
                        {"mask_height", std::vector{400.0, 1e5}},
                        {"mask_height_feather", 0.0}});
  const TerrainResult result = steps.evaluate(small);
  const Grid<float>& h = result.field.height;
  EXPECT_NEAR(h(100, 9), 36 * 8 + 7, 1e-3);
  EXPECT_NEAR(h(20, 9), -44 * 8 + 3, 1e-3);
  EXPECT_NEAR(h(128, 9), 512 + 7 + 50, 1e-3);
  EXPECT_EQ(result.maps.at("high")(100, 9), 1);
  EXPECT_EQ(result.maps.at("mask")(20, 9), 0);
}

TEST(TerrainSteps, TilesAgreeAtTheirBorders) {
  const Steps steps = landscape();
  const TerrainWindow whole = window_of(small);
  const Grid<float> all = steps.evaluate(small).field.height;
  const TerrainWindow tile{whole.origin + whole.cell * DVec2(64, 32), whole.cell, 65, 65};
  const Grid<float> part = steps.evaluate(small, tile).field.height;
  float largest = 0;
  for (int j = 0; j < 65; ++j)
    for (int i = 0; i < 65; ++i)
      largest = std::max(largest, std::abs(part(i, j) - all(i + 64, j + 32)));
  EXPECT_LE(largest, 1e-4F);
}

TEST(TerrainSteps, GoesOnOutsideTheDomain) {
  const Steps steps = landscape();
  const TerrainWindow whole = window_of(small);
  const TerrainWindow around{whole.origin - 1.5 * DVec2(small.size), 4 * whole.cell, 129, 129};
  const Heightfield surrounding = steps.evaluate(small, around).field;
  EXPECT_EQ(surrounding.size(), DVec2(4096));
  const Heightfield ground = steps.evaluate(small).field;
  double sum = 0;
  for (int j = 0; j < 33; ++j)
    for (int i = 0; i < 33; ++i) {
      const double d = surrounding.height(48 + i, 48 + j) - ground.height(4 * i, 4 * j);
      sum += d * d;
    }
  EXPECT_LT(std::sqrt(sum / (33 * 33)), 25);  // coarser terraces and slopes, but the same hills
}

/// Root of the mean square of the difference where the coarse grid has samples, in parts of the
/// height's extent.
double resolution_difference(const Steps& steps) {
  TerrainSettings coarse = small;
  TerrainSettings fine = small;
  coarse.resolution = 129;
  fine.resolution = 513;
  const Heightfield a = steps.evaluate(coarse).field;
  const Heightfield b = steps.evaluate(fine).field;
  double sum = 0;
  for (int j = 0; j < 129; ++j)
    for (int i = 0; i < 129; ++i) {
      const double d = a.height(i, j) - b.height(4 * i, 4 * j);
      sum += d * d;
    }
  const HeightStatistics extent = height_statistics(b);
  return std::sqrt(sum / (129 * 129)) / static_cast<double>(extent.max - extent.min);
}

TEST(TerrainSteps, ResolutionChangesOnlyFineDetail) {
  for (const char* op : {"fbm", "hybrid", "ridged", "turbulence", "eroded_noise", "diamond_square"})
    EXPECT_LT(resolution_difference(Steps().add(op)), 0.01) << op;
}

TEST(TerrainSteps, CoarserGroundLiesNoLower) {
  for (const char* op : {"fbm", "hybrid", "ridged", "turbulence", "eroded_noise"}) {
    Steps steps;
    steps.add(op, {{"height", 100.0}, {"feature_size", 500.0}, {"hurst", 0.7}});
    const TerrainResult fine = steps.evaluate({.size = 8192, .resolution = 513});
    const TerrainResult coarse = steps.evaluate({.size = 8192, .resolution = 65});
    EXPECT_NEAR(height_statistics(fine.field).mean, height_statistics(coarse.field).mean, 1.5)
        << op;
  }
}

TEST(TerrainSteps, HeightIsTheExtentWhateverTheParameters) {
  const TerrainSettings large{.size = 10000, .resolution = 513};
  for (const char* op : {"fbm", "hybrid", "ridged", "turbulence", "eroded_noise"})
    for (const double hurst : {0.6, 1.0}) {
      Steps steps;
      steps.add(op,
                {{"height", 100.0}, {"base", 50.0}, {"feature_size", 1000.0}, {"hurst", hurst}});
      std::vector<float> h;
      const TerrainResult result = steps.evaluate(large);
      h.assign(result.field.height.values().begin(), result.field.height.values().end());
      std::sort(h.begin(), h.end());
      EXPECT_NEAR(h[h.size() / 200], 50, 8) << op << hurst;
      EXPECT_NEAR(h[h.size() - h.size() / 200], 150, 8) << op << hurst;
    }
}

TEST(TerrainSteps, SameBitsForAnyNumberOfThreads) {
  std::vector<Grid<float>> results;
  for (const int threads : {1, 2, 4}) {
    const ThreadLimit limit(threads);
    results.push_back(landscape().evaluate(small).field.height);
  }
  EXPECT_EQ(results[0], results[1]);
  EXPECT_EQ(results[0], results[2]);
}

TEST(TerrainSteps, CanBeCancelled) {
  Progress progress;
  progress.cancel();
  const Steps steps = landscape();
  EXPECT_NE(error_text([&] { evaluate(small, steps.list(), steps.operators(), 1, {}, progress); },
                       ErrorKind::cancelled),
            "no error");
}

TEST(TerrainSteps, EachIsAStageOfTheProgressToItsEnd) {
  std::vector<std::string> finished;
  Progress progress([&](const ProgressReport& r) {
    EXPECT_NE(r.stage, "");
    if (r.finished && !r.inner) finished.push_back(r.stage);
  });
  const Steps steps = landscape();
  evaluate(small, steps.list(), steps.operators(), 1, {}, progress);
  EXPECT_EQ(finished,
            (std::vector<std::string>{"ridged", "warp", "fbm", "flats", "blur", "terrace"}));
}

TEST(TerrainSteps, UnknownOperatorSuggestsTheNearest) {
  EXPECT_EQ(error_text([] {
              make_step(terrain_operators(), "rigded", {"scene.toml", 12, 6});
            }),
            "scene.toml:12:6: unknown terrain operator 'rigded'. Did you mean 'ridged'?");
}

TEST(TerrainSteps, UnknownParameterSuggestsTheNearestOfBothKinds) {
  TerrainStep step = make_step(terrain_operators(), "ridged");
  EXPECT_EQ(error_text([&] {
              assign(step, "octave", std::int64_t{3}, {"scene.toml", 13, 1});
            }),
            "scene.toml:13:1: unknown parameter 'octave' in 'ridged'. Did you mean 'octaves'?");
  EXPECT_EQ(error_text([&] { assign(step, "opacty", 0.5); }),
            "unknown parameter 'opacty' in 'ridged'. Did you mean 'opacity'?");
}

TEST(TerrainSteps, NoParameterHidesACommonSetting) {
  const ParameterSet common = describe(StepSettings{});
  for (const TerrainOperator& op : terrain_operators()) {
    for (const Parameter& p : op.defaults.parameters().parameters)
      EXPECT_EQ(common.find(p.name), nullptr) << op.name() << " " << p.name;
    EXPECT_FALSE(op.text().empty());
  }
}

TEST(TerrainSteps, DefaultsAreWithinTheirLimits) {
  for (const TerrainOperator& op : terrain_operators()) {
    Described copy = op.defaults;
    for (const Parameter& p : op.defaults.parameters().parameters)
      EXPECT_NO_THROW(copy.assign(p.name, p.get(op.defaults.data()))) << op.name() << " " << p.name;
  }
  StepSettings settings;
  const ParameterSet common = describe(settings);
  for (const Parameter& p : common.parameters)
    EXPECT_NO_THROW(common.assign(&settings, p.name, p.get(&settings))) << p.name;
}

TEST(TerrainSteps, ReferencesAreCheckedBeforeTheWork) {
  EXPECT_EQ(error_text([] {
              Steps steps;
              steps.add("fbm", {{"name", std::string("hills")}});
              steps.add("combine", {{"with", std::string("hils")}});
              steps.evaluate(small);
            }),
            "scene.toml:2: step 'hils' is no named step before this one. Did you mean 'hills'?");
  EXPECT_EQ(error_text([] {
              Steps().add("blur", {{"input", std::string("x")}}).evaluate(small);
            }),
            "scene.toml:1: input 'x' is no named step before this one.");
  EXPECT_EQ(error_text([] {
              Steps steps;
              steps.add("mask").add("blur", {{"mask", std::string("maks")}}).evaluate(small);
            }),
            "scene.toml:2: mask 'maks' is neither a map or step before this one nor a picture. "
            "Did you mean 'mask'?");
  EXPECT_EQ(error_text([] {
              Steps steps;
              steps.add("fbm", {{"name", std::string("a")}});
              steps.add("fbm", {{"name", std::string("a")}}).evaluate(small);
            }),
            "scene.toml:2: a step before this one is also named 'a'");
}

TEST(TerrainSteps, MissingFilesAreNamed) {
  EXPECT_EQ(error_text([] {
              Steps()
                  .add("import", {{"file", std::string("dem.png")}})
                  .evaluate(small, 1, "/nonexistent");
            }),
            "scene.toml:1: the file '/nonexistent/dem.png' does not exist");
  EXPECT_EQ(error_text([] { Steps().add("import").evaluate(small); }),
            "scene.toml:1: 'import' needs a 'file'");
  EXPECT_EQ(
      error_text([] {
        Steps().add("fbm", {{"mask", std::string("m.png")}}).evaluate(small, 1, "/nonexistent");
      }),
      "scene.toml:1: mask '/nonexistent/m.png' does not exist");
}

TEST(TerrainSteps, APictureThatIsNoneIsNamedWithItsStep) {
  const TemporaryFolder folder;
  std::ofstream(folder.file("dem.png")) << "this is no picture";
  const std::string text = error_text([&] {
    Steps().add("import", {{"file", std::string("dem.png")}}).evaluate(small, 1, folder.path());
  });
  EXPECT_NE(text.find("scene.toml:1: "), std::string::npos) << text;
  EXPECT_NE(text.find("dem.png"), std::string::npos) << text;
}

TEST(TerrainSteps, WhatCannotFitIsRefusedWithItsSize) {
  TerrainSettings huge = small;
  huge.resolution = 4000000;
  const std::string text = error_text([&] { Steps().add("fbm").evaluate(huge); }, ErrorKind::limit);
  EXPECT_EQ(text.find("a terrain of 4000000 x 4000000 samples needs about "), 0U) << text;
  EXPECT_NE(text.find(" TB, but "), std::string::npos) << text;
  EXPECT_NE(text.find(" would fit"), std::string::npos) << text;
}

}  // namespace
}  // namespace wold
