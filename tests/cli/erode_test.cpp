// `wold erode`: a height map of one's own, eroded.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "image/io.hpp"
#include "process.hpp"
#include "terrain/elevation.hpp"
#include "terrain/export.hpp"

namespace wold {
namespace {

using nlohmann::json;
using testing::Outcome;
using testing::Workplace;
using Words = std::vector<std::string>;

/// A ridge with a hollow in it, 20 m apart.
Heightfield ridge() {
  Heightfield field{Grid<float>(65, 49), {0, 0}, 20};
  for (int j = 0; j < 49; ++j)
    for (int i = 0; i < 65; ++i)
      field.height(i, j) = static_cast<float>(400 - 8 * std::abs(j - 24) + 20 * std::sin(0.4 * i) +
                                              (i == 30 && j == 10 ? -60 : 0));
  return field;
}

class Erode : public ::testing::Test {
 protected:
  Erode() {
    export_heightfield(ridge(), place_.path("ridge.exr").string());
    export_heightfield(ridge(), place_.path("ridge.png").string(), {.range = Range{0, 800}});
    Image plain(65, 49, {"Y"}, 0.5F);
    write_png(place_.path("plain.png").string(), plain);
  }

  Workplace place_;
};

TEST_F(Erode, WritesGroundMapsAndReport) {
  const Outcome done =
      place_.run({"erode", "ridge.exr", "--op", "drainage", "--op", "thermal", "--set",
                  "thermal.talus_angle=25", "-o", "out.exr", "-o", "out.glb", "--maps", "maps",
                  "--map-pictures", "--preview", "preview.png", "--json"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  const json report = json::parse(done.out);
  EXPECT_EQ(report["steps"], json({"drainage", "thermal"}));
  EXPECT_EQ(report["cell"], 20.0);
  EXPECT_EQ(report["files"].size(), 2U);
  ASSERT_FALSE(report["balances"].empty());
  for (const json& b : report["balances"]) {
    EXPECT_LE(std::abs(b["relative_error"].get<double>()), 1e-6) << b;
    EXPECT_NEAR(b["before"].get<double>() + b["added"].get<double>() - b["removed"].get<double>(),
                b["after"].get<double>(), 1e-6 * b["moved"].get<double>())
        << b;
  }
  for (const char* file : {"out.exr", "out.glb", "preview.png", "maps/area.exr", "maps/area.png",
                           "maps/slope.exr", "maps/wear.exr"})
    EXPECT_TRUE(place_.has(file)) << file;
  const Elevation out = read_elevation(place_.path("out.exr").string());
  EXPECT_EQ(out.spacing, DVec2(20));
  EXPECT_FALSE(out.height == ridge().height);
}

TEST_F(Erode, IntegersKeepTheirMeaning) {
  const Outcome done =
      place_.run({"erode", "ridge.png", "--op", "blur", "-o", "out.png", "--json"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_EQ(json::parse(done.out)["files"][0]["range"], json({0.0, 800.0}));
}

TEST_F(Erode, AskedForSizeAndHeight) {
  const Outcome done = place_.run({"erode", "plain.png", "--size", "640x480", "--height", "100:300",
                                   "--op", "blur", "-o", "out.exr", "--json"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  const json report = json::parse(done.out);
  EXPECT_EQ(report["cell"], 10.0);
  EXPECT_NEAR(report["heights"]["mean"].get<double>(), 200, 0.01);
}

TEST_F(Erode, MaskKeepsWhatIsBlack) {
  Image mask(65, 49, {"Y"});
  for (int y = 0; y < 49; ++y)
    for (int x = 33; x < 65; ++x) mask.at(x, y, 0) = 1;
  write_png(place_.path("mask.png").string(), mask);
  const Outcome done = place_.run({"erode", "ridge.exr", "--op", "blur", "--set", "distance=60",
                                   "--mask", "mask.png", "-o", "out.exr"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  const Grid<float> out = read_elevation(place_.path("out.exr").string()).height;
  const Grid<float> before = ridge().height;
  EXPECT_EQ(out(10, 24), before(10, 24));
  EXPECT_NE(out(50, 24), before(50, 24));
}

TEST_F(Erode, SameFileOnAnyNumberOfThreads) {
  for (const char* threads : {"1", "2", "4"}) {
    const std::string name = std::string("t") + threads + ".exr";
    ASSERT_EQ(
        place_.run({"erode", "ridge.exr", "--op", "thermal", "--threads", threads, "-o", name})
            .exit_code,
        0);
    EXPECT_EQ(place_.read(name), place_.read("t1.exr")) << threads;
  }
}

TEST_F(Erode, DoesTheStepsOfAScene) {
  place_.write("steps.toml",
               "[[terrain.step]]\nop = \"blur\"\n[[terrain.step]]\nop = \"thermal\"\n");
  const Outcome done =
      place_.run({"erode", "ridge.exr", "--steps", "steps.toml", "-o", "out.exr", "--json"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_EQ(json::parse(done.out)["steps"], json({"blur", "thermal"}));
}

struct ErodeMistake {
  std::string name;
  Words arguments;
  int exit_code;
  Words parts;
};

class ErodeErrors : public Erode, public ::testing::WithParamInterface<ErodeMistake> {};

TEST_P(ErodeErrors, AreOneLineAndWriteNothing) {
  const std::string before = place_.files();
  Words arguments{"erode"};
  arguments.insert(arguments.end(), GetParam().arguments.begin(), GetParam().arguments.end());
  const Outcome outcome = place_.run(arguments);
  EXPECT_EQ(outcome.exit_code, GetParam().exit_code) << outcome.err;
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  for (const std::string& part : GetParam().parts)
    EXPECT_NE(outcome.err.find(part), std::string::npos) << part << " is not in " << outcome.err;
  EXPECT_EQ(place_.files(), before);
}

INSTANTIATE_TEST_SUITE_P(
    Each, ErodeErrors,
    ::testing::Values(
        ErodeMistake{"NoFile", {"no.exr", "--op", "blur", "-o", "o.exr"}, 1, {"does not exist"}},
        ErodeMistake{"NoOperator", {"ridge.exr", "-o", "o.exr"}, 2, {"--op NAME", "--steps"}},
        ErodeMistake{"UnknownOperator",
                     {"ridge.exr", "--op", "thermql", "-o", "o.exr"},
                     1,
                     {"'thermql'", "Did you mean 'thermal'?"}},
        ErodeMistake{"NoOutput", {"ridge.exr", "--op", "blur"}, 2, {"-o eroded.exr"}},
        ErodeMistake{
            "OutputFormat", {"ridge.exr", "--op", "blur", "-o", "o.foo"}, 2, {"o.foo", ".exr"}},
        ErodeMistake{"UnknownSize",
                     {"plain.png", "--op", "blur", "-o", "o.exr"},
                     2,
                     {"plain.png", "--size 4000"}},
        ErodeMistake{"CellsNotSquare",
                     {"plain.png", "--size", "640x640", "--op", "blur", "-o", "o.exr"},
                     2,
                     {"10 x 13.33 m", "--size 640x480"}},
        ErodeMistake{"SizeNoNumber",
                     {"plain.png", "--size", "4km", "--op", "blur", "-o", "o.exr"},
                     2,
                     {"4km", "4000x3000"}},
        ErodeMistake{
            "HeightReversed",
            {"plain.png", "--size", "640", "--height", "9:3", "--op", "blur", "-o", "o.exr"},
            2,
            {"9:3", "200:1700"}},
        ErodeMistake{"NegativeParameter",
                     {"ridge.exr", "--op", "blur", "--set", "distance=-2", "-o", "o.exr"},
                     1,
                     {"'distance'", "-2", "0 to 100000 m"}},
        ErodeMistake{"UnknownParameter",
                     {"ridge.exr", "--op", "blur", "--set", "distence=2", "-o", "o.exr"},
                     1,
                     {"'distence'", "Did you mean 'distance'?"}},
        ErodeMistake{"SettingIsShownAsTyped",
                     {"ridge.exr", "--op", "thermal", "--set", "talus_angel=3", "-o", "o.exr"},
                     1,
                     {"--set talus_angel=3: error: ", "Did you mean 'talus_angle'?"}},
        ErodeMistake{"SettingOfAnOperatorIsShownAsTyped",
                     {"ridge.exr", "--op", "blur", "--op", "thermal", "--seed", "3", "--set",
                      "1.talus_angle=steep", "-o", "o.exr"},
                     1,
                     {"--set 1.talus_angle=steep: error: ", "a number"}},
        ErodeMistake{"SettingOfNone",
                     {"ridge.exr", "--op", "blur", "--set", "9.distance=3", "-o", "o.exr"},
                     2,
                     {"'--set 9.distance=3': nothing is called '9' there"}},
        ErodeMistake{"MapsInAFile",
                     {"ridge.exr", "--op", "blur", "-o", "o.exr", "--maps", "ridge.exr/maps"},
                     1,
                     {"cannot write into 'ridge.exr/maps': 'ridge.exr' is no folder"}},
        ErodeMistake{
            "SettingOfWhich",
            {"ridge.exr", "--op", "blur", "--op", "thermal", "--set", "distance=2", "-o", "o.exr"},
            2,
            {"OPERATOR.distance=2"}},
        ErodeMistake{"BadSeed",
                     {"ridge.exr", "--op", "blur", "--seed", "x", "-o", "o.exr"},
                     2,
                     {"--seed x"}}),
    [](const auto& mistake) { return mistake.param.name; });

/// A second of work.
Words slow_erosion(const Words& outputs) {
  Words words{"erode", "ridge.exr", "--op", "droplets", "--set", "rain=3", "--threads", "1"};
  words.insert(words.end(), outputs.begin(), outputs.end());
  return words;
}

TEST_F(Erode, GroundIsKeptWhenItsFolderHasGone) {
  std::filesystem::create_directory(place_.path("gone"));
  place_.write("out.exr", "mine");
  const Words words =
      slow_erosion({"-o", "gone/out.exr", "-o", "second.png", "--maps", "gone/maps", "--json"});
  const Outcome outcome = place_.during(
      words, "ridge.exr: ", [&] { std::filesystem::remove_all(place_.path("gone")); });
  EXPECT_EQ(outcome.exit_code, 1);
  const json report = json::parse(outcome.out);
  ASSERT_EQ(report["files"].size(), 2U) << outcome.err;
  const std::string kept = report["files"][0]["path"];
  EXPECT_EQ(std::filesystem::path(kept).filename(), "out-2.exr");
  EXPECT_NE(outcome.err.find("wold: error: cannot write 'gone/out.exr': the folder 'gone' does not "
                             "exist; saved as '" +
                             kept + "' instead\n"),
            std::string::npos)
      << outcome.err;
  EXPECT_EQ(read_elevation(place_.path("out-2.exr").string()).spacing, DVec2(20));
  EXPECT_EQ(place_.read("out.exr"), "mine");
  EXPECT_TRUE(place_.has("second.png"));
  EXPECT_TRUE(place_.has("gone/maps/slope.exr")) << "a folder for maps is made";
}

TEST_F(Erode, GroundIsKeptAmongTemporaryFilesWhenThereIsNoOtherPlace) {
  const Outcome outcome = place_.during(slow_erosion({"-o", "out.exr"}), "ridge.exr: ", [&] {
    std::filesystem::remove_all(place_.path(""));
  });
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_TRUE(std::filesystem::exists(place_.temporary("out.exr"))) << outcome.err;
  EXPECT_NE(outcome.err.find("saved as '" + place_.temporary("out.exr").string() + "' instead\n"),
            std::string::npos)
      << outcome.err;
}

TEST_F(Erode, MapsAreKeptBesideAFileOfTheirName) {
  const Outcome outcome = place_.run({"erode", "ridge.exr", "--op", "blur", "-o", "o.exr", "--maps",
                                      "o.exr", "--preview", "p.png"});
  EXPECT_EQ(outcome.exit_code, 1);
  for (const char* file : {"o.exr", "o-2.exr/slope.exr", "p.png"})
    EXPECT_TRUE(place_.has(file)) << file;
  EXPECT_NE(outcome.err.find("wold: error: cannot make the folder 'o.exr'"), std::string::npos)
      << outcome.err;
}

TEST_F(Erode, EveryFileIsTriedThoughOthersFail) {
  const Words words{"erode", "ridge.exr", "--op",   "blur", "-o", "large.obj",
                    "-o",    "small.r16", "--maps", "maps", "-q"};
  const Outcome outcome = place_.run_with_files_up_to(6500, words);
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_NE(outcome.err.find("'large.obj'"), std::string::npos) << outcome.err;
  EXPECT_EQ(place_.read("small.r16").size(), 2U * 65 * 49);
  EXPECT_EQ(place_.files(), "plain.png ridge.exr ridge.png scene.toml small.r16 tree.lsys")
      << "nothing half-written, no empty folder";
}

TEST_F(Erode, MaskThatIsNotThere) {
  const Outcome outcome =
      place_.run({"erode", "ridge.exr", "--op", "blur", "--mask", "no.png", "-o", "o.exr", "-q"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(outcome.err, "wold: error: mask 'no.png' does not exist\n");
  EXPECT_FALSE(place_.has("o.exr"));
}

TEST_F(Erode, HeightsThatAreNoNumbers) {
  Heightfield field = ridge();
  field.height(3, 2) = std::nanf("");
  export_heightfield(field, place_.path("nan.exr").string());
  const Outcome outcome =
      place_.run({"erode", "nan.exr", "--op", "thermal", "-o", "o.exr", "--quiet"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.err.find("sample (3, 2)"), std::string::npos) << outcome.err;
  EXPECT_FALSE(place_.has("o.exr"));
}

}  // namespace
}  // namespace wold
