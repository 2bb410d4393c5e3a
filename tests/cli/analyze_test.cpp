// `wold analyze`: numbers and plots of a height map.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "image/io.hpp"
#include "process.hpp"
#include "terrain/export.hpp"

namespace wold {
namespace {

using nlohmann::json;
using testing::Outcome;
using testing::Workplace;

/// Hills of 200 m, 1280 m apart, `lift` higher than they should be.
Heightfield hills(int side, float lift = 0) {
  Heightfield field{Grid<float>(side, side), {0, 0}, 2560.0 / (side - 1)};
  for (int j = 0; j < side; ++j)
    for (int i = 0; i < side; ++i) {
      const DVec2 p = field.cell * DVec2(i, j);
      field.height(i, j) = lift + static_cast<float>(100 * std::sin(p.x * 6.2832 / 1280) *
                                                     std::cos(p.y * 6.2832 / 1280));
    }
  return field;
}

TEST(Analyze, TellsFiguresAndWritesPlots) {
  const Workplace place;
  export_heightfield(hills(129), place.path("h.exr").string());
  const Outcome done = place.run({"analyze", "h.exr", "--plots", "plots", "--json"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  const json report = json::parse(done.out);
  EXPECT_EQ(report["cell"], 20.0);
  EXPECT_NEAR(report["figures"]["relief"]["value"].get<double>(), 200, 1);
  EXPECT_EQ(report["figures"]["relief"]["unit"], "m");
  for (const char* plot : {"hillshade", "drainage", "slope_area", "spectrum", "hypsometry"}) {
    const std::string file = std::string("plots/") + plot + ".png";
    ASSERT_TRUE(place.has(file)) << file;
    EXPECT_GE(read_picture(place.path(file).string()).image.height, 600) << file;
  }
}

TEST(Analyze, PrintsATableThatPeopleCanRead) {
  const Workplace place;
  export_heightfield(hills(65), place.path("h.exr").string());
  const Outcome done = place.run({"analyze", "h.exr", "-q"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_EQ(done.err, "");
  for (const char* word : {"relief", "concavity", "spectrum", "natural: "})
    EXPECT_NE(done.out.find(word), std::string::npos) << word;
}

TEST(Analyze, ComparesMapsOfDifferentResolution) {
  const Workplace place;
  export_heightfield(hills(65), place.path("coarse.exr").string());
  export_heightfield(hills(129), place.path("fine.exr").string());
  export_heightfield(hills(129, 20), place.path("lifted.exr").string());
  const auto difference = [&](const char* other) {
    const Outcome done = place.run({"analyze", "coarse.exr", "--against", other, "--json", "-q"});
    EXPECT_EQ(done.exit_code, 0) << done.err;
    return json::parse(done.out)["difference"]["relative_rms"].get<double>();
  };
  EXPECT_LT(difference("fine.exr"), 0.005);
  EXPECT_NEAR(difference("lifted.exr"), 0.1, 0.005);  // 20 m of 200 m
}

TEST(Analyze, FlatGroundHasNoConcavity) {
  const Workplace place;
  export_heightfield({Grid<float>(33, 33, 5), {0, 0}, 10}, place.path("flat.exr").string());
  const Outcome done = place.run({"analyze", "flat.exr", "--json"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_TRUE(json::parse(done.out)["figures"]["concavity"]["value"].is_null());
}

TEST(Analyze, LeavesNoEmptyFolderWhenPlotsDoNotFit) {
  const Workplace place;
  export_heightfield(hills(33), place.path("h.exr").string());
  const Outcome outcome =
      place.run_with_files_up_to(2000, {"analyze", "h.exr", "--plots", "plots", "-q"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.err.find("larger than allowed"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.out.find("relief"), std::string::npos) << "the figures are told all the same";
  EXPECT_EQ(place.files(), "h.exr scene.toml tree.lsys");
}

TEST(Analyze, MistakesAreOneLine) {
  const Workplace place;
  export_heightfield(hills(33), place.path("h.exr").string());
  const auto expect = [&](const std::vector<std::string>& arguments, int code,
                          const std::string& part) {
    const Outcome outcome = place.run(arguments);
    EXPECT_EQ(outcome.exit_code, code) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
  };
  expect({"analyze", "no.exr"}, 1, "does not exist");
  expect({"analyze", "h.exr", "--channel-area", "-5"}, 2, "--channel-area");
  expect({"analyze", "h.exr", "--against", "no.exr", "-q"}, 1, "'no.exr' does not exist");
  expect({"analyze", "h.exr", "--plots", "h.exr"}, 1, "it is no folder");
}

}  // namespace
}  // namespace wold
