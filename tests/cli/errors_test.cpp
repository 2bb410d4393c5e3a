// Every mistake a user can make: one line that says where and what would be right, the right exit
// code, and nothing half-written.

#include <gtest/gtest.h>

#include <algorithm>

#include "process.hpp"

namespace wold {
namespace {

using testing::Outcome;
using testing::Workplace;
using Words = std::vector<std::string>;

void expect_one_line(const Outcome& outcome, int exit_code, const Words& parts) {
  EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  for (const std::string& part : parts)
    EXPECT_NE(outcome.err.find(part), std::string::npos)
        << "'" << part << "' is not in: " << outcome.err;
}

/// A mistake in the scene file, found by `render` and by `check`, before any work and at its line.
struct SceneMistake {
  std::string name;
  std::string text;  ///< appended to the small scene, from line 29 on
  Words parts;
};

class SceneErrors : public ::testing::TestWithParam<SceneMistake> {};

TEST_P(SceneErrors, AreOneLineWithThePlace) {
  const Workplace place;
  place.write("scene.toml", std::string(testing::small_scene) + GetParam().text);
  place.write("nopicture.png", "this is a text");
  const std::string before = place.files();
  for (const Words& command :
       {Words{"check", "scene.toml"}, Words{"render", "scene.toml", "-o", "a.exr", "-o", "b.png"}})
    expect_one_line(place.run(command), 1, GetParam().parts);
  EXPECT_EQ(place.files(), before);
}

INSTANTIATE_TEST_SUITE_P(
    Each, SceneErrors,
    ::testing::Values(
        SceneMistake{"MisspeltParameter",
                     "[sky]\nturbidty = 2\n",
                     {"scene.toml:30:1: error: ", "'turbidty'", "Did you mean 'turbidity'?"}},
        SceneMistake{"WrongType",
                     "[sky]\nturbidity = \"high\"\n",
                     {"scene.toml:30:13: error: ", "'turbidity'", "\"high\"", "a number"}},
        SceneMistake{"OutOfRange",
                     "[sky]\nturbidity = 2000\n",
                     {"scene.toml:30:13: error: ", "2000", "1.9 to 10"}},
        SceneMistake{"RangeReversed",
                     "[ground]\nrock_slope = [40, 20]\n",
                     {"scene.toml:30:14: error: ", "[40, 20]", "[low, high]"}},
        SceneMistake{"UnknownChoice",
                     "[picture]\ntone_map = \"agxx\"\n",
                     {"scene.toml:30:", "error: ", "agx"}},
        SceneMistake{"UnknownSection",
                     "[skye]\nturbidity = 2\n",
                     {"scene.toml:29:2: error: ", "'skye'", "Did you mean 'sky'?"}},
        SceneMistake{
            "SectionThatIsAList", "[[sky]]\nturbidity = 2\n", {"scene.toml:29:", "'sky'", "[sky]"}},
        SceneMistake{"UnknownOperator",
                     "[[terrain.step]]\nop = \"ridgd\"\n",
                     {"scene.toml:30:6: error: ", "'ridgd'", "Did you mean 'ridged'?"}},
        SceneMistake{"StepWithoutOperator",
                     "[[terrain.step]]\nheight = 5\n",
                     {"scene.toml:29:1: error: ", "op = \"ridged\""}},
        SceneMistake{"MisspeltParameterOfAStep",
                     "[[terrain.step]]\nop = \"ridged\"\noctave = 5\n",
                     {"scene.toml:31:1: error: ", "'octave'", "Did you mean 'octaves'?"}},
        SceneMistake{"UnknownSpeciesInScatter",
                     "[[scatter]]\nspecies = { tre = 2 }\n",
                     {"scene.toml:30:11: error: ", "'tre'", "Did you mean 'tree'?"}},
        SceneMistake{"TwoSpeciesOfOneName",
                     "[[species]]\nname = \"tree\"\nplant = \"tree.lsys\"\n",
                     {"scene.toml:30:8: error: ", "'tree'"}},
        SceneMistake{"SpeciesWithoutName",
                     "[[species]]\nplant = \"tree.lsys\"\n",
                     {"scene.toml:29:1: error: ", "name"}},
        SceneMistake{"SpeciesWithoutPlant",
                     "[[species]]\nname = \"fern\"\n",
                     {"scene.toml:29:1: error: ", "plant = "}},
        SceneMistake{"MissingPlantFile",
                     "[[species]]\nname = \"fern\"\nplant = \"fernn.lsys\"\n",
                     {"scene.toml:31:9: error: ", "fernn.lsys"}},
        SceneMistake{"MissingPicture",
                     "[[terrain.step]]\nop = \"import\"\nfile = \"nofile.png\"\n",
                     {"scene.toml:29:1: error: ", "nofile.png", "does not exist"}},
        SceneMistake{"MissingMask",
                     "[[scatter]]\nmask = \"nomask\"\n",
                     {"scene.toml:30:8: error: ", "'nomask'"}},
        SceneMistake{"SunWithOneNumber",
                     "[sky]\nsun = [30]\n",
                     {"scene.toml:30:7: error: ", "[elevation, azimuth]"}},
        SceneMistake{"CameraAtOneNumber",
                     "[camera]\nposition = [1]\n",
                     {"scene.toml:29:", "error: ", "'position'", "2 or 3"}},
        SceneMistake{"TwoCamerasOfOneName",
                     "[[camera]]\nname = \"a\"\n[[camera]]\nname = \"a\"\n",
                     {"scene.toml:32:8: error: ", "'a'"}},
        SceneMistake{"BadToml", "[sky\nturbidity = 2\n", {"scene.toml:29:", "not valid TOML"}},
        SceneMistake{"NoValue", "x =\n", {"scene.toml:29:", "not valid TOML"}},
        SceneMistake{"StepOutOfRange",
                     "[[terrain.step]]\nop = \"blur\"\ndistance = -1\n",
                     {"scene.toml:31:12: error: ", "'distance'"}}),
    [](const auto& test) { return test.param.name; });

/// A mistake on the command line.
struct UsageMistake {
  std::string name;
  Words arguments;
  int exit_code = 2;
  Words parts;
};

class UsageErrors : public ::testing::TestWithParam<UsageMistake> {};

TEST_P(UsageErrors, AreOneLine) {
  const Workplace place;
  std::filesystem::create_directory(place.path("folder.png"));
  place.write("there.toml", "");
  const std::string before = place.files();
  expect_one_line(place.run(GetParam().arguments), GetParam().exit_code, GetParam().parts);
  EXPECT_EQ(place.files(), before);
}

Words render_to(const std::string& output) {
  return {"render", "scene.toml", "-o", output};
}
Words render_with(const std::string& option, const std::string& value) {
  return {"render", "scene.toml", "-o", "x.png", option, value};
}
Words set(const std::string& assignment) {
  return {"check", "scene.toml", "--set", assignment};
}

INSTANTIATE_TEST_SUITE_P(
    CommandLine, UsageErrors,
    ::testing::Values(
        UsageMistake{"Nothing", {}, 2, {"command", "wold --help"}},
        UsageMistake{
            "UnknownCommand", {"rendr"}, 2, {"'rendr'", "Did you mean 'render'?", "wold --help"}},
        UsageMistake{"UnknownOption", {"check", "scene.toml", "--speed"}, 2, {"--speed"}},
        UsageMistake{"NoScene", {"render"}, 2, {"scene"}},
        UsageMistake{"NoHelp", {"help", "volcano"}, 2, {"'volcano'", "Known: render"}},
        UsageMistake{"NearHelp", {"help", "ridgd"}, 2, {"Did you mean 'ridged'?"}},
        UsageMistake{"Threads", render_with("--threads", "0"), 2, {"--threads", "1 to 4096"}},
        UsageMistake{"Size", render_with("--size", "10"), 2, {"'--size 10'", "1280x720"}},
        UsageMistake{"SizeWords", render_with("--size", "axb"), 2, {"'--size axb'", "1280x720"}},
        UsageMistake{"SizeZero", render_with("--size", "0x5"), 2, {"'--size 0x5'", "1 to 65536"}},
        UsageMistake{"SizeNegative", render_with("--size", "-5x5"), 2, {"'--size -5x5'"}},
        UsageMistake{"SizeHuge", render_with("--size", "65537x2"), 2, {"1 to 65536"}},
        UsageMistake{"SizeOverflow", render_with("--size", "99999999999x3"), 2, {"--size"}},
        UsageMistake{"SamplesNone", render_with("--samples", "0"), 2, {"'--samples 0'", "0:32"}},
        UsageMistake{"SamplesEmpty", render_with("--samples", "5:5"), 2, {"--samples 5:5"}},
        UsageMistake{"SamplesReversed", render_with("--samples", "8:4"), 2, {"--samples 8:4"}},
        UsageMistake{"SamplesOpen", render_with("--samples", "8:"), 2, {"--samples 8:"}},
        UsageMistake{"SamplesText", render_with("--samples", "many"), 2, {"--samples many"}},
        UsageMistake{"SamplesThree", render_with("--samples", "1:2:3"), 2, {"--samples"}},
        UsageMistake{"SeedNegative", render_with("--seed", "-1"), 2, {"'--seed -1'", "0 to"}},
        UsageMistake{"SeedText", render_with("--seed", "abc"), 2, {"'--seed abc'", "integer"}},
        UsageMistake{"SeedHuge", render_with("--seed", "9007199254740993"), 2, {"--seed"}},
        UsageMistake{"Camera", render_with("--camera", "top"), 2, {"'top'", "Known: main"}},
        UsageMistake{"MissingScene", {"render", "nofile.toml"}, 1, {"nofile.toml", "no such file"}},
        UsageMistake{"SceneIsFolder", {"check", "folder.png"}, 1, {"folder.png", "folder"}},
        UsageMistake{"SceneIsEmptyName", {"check", ""}, 1, {"''"}},
        UsageMistake{"SceneIsNoToml", {"check", "tree.lsys"}, 1, {"tree.lsys:1:1", "TOML"}},
        UsageMistake{"OutputFolderMissing", render_to("no/x.png"), 1, {"'no' does not exist"}},
        UsageMistake{"OutputExtension", render_to("x.jpg"), 2, {"'.jpg'", ".exr, .png"}},
        UsageMistake{"OutputNoExtension", render_to("x"), 2, {"no extension", ".exr, .png"}},
        UsageMistake{"OutputIsFolder", render_to("folder.png"), 1, {"it is a folder"}},
        UsageMistake{"OutputEmpty", render_to(""), 2, {"empty"}},
        UsageMistake{"NewIsThere", {"new", "there"}, 2, {"there.toml", "choose another name"}},
        UsageMistake{"NewNoFolder", {"new", "no/scene"}, 1, {"'no' does not exist"}},
        UsageMistake{"PictureTooLarge",
                     render_with("--size", "65536x65536"),
                     1,
                     {"65536 x 65536 needs", "GB", "smaller size"}}),
    [](const auto& test) { return test.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Settings, UsageErrors,
    ::testing::Values(
        UsageMistake{"NoEquals", set("foo"), 2, {"'--set foo'", "path=value"}},
        UsageMistake{"NoPath", set("=4"), 2, {"'--set =4'", "path=value"}},
        UsageMistake{"UnknownParameter",
                     set("terrain.sizee=4"),
                     1,
                     {"--set terrain.sizee=4", "Did you mean 'size'?"}},
        UsageMistake{"UnknownSection", set("terrainn.size=4"), 1, {"Did you mean 'terrain'?"}},
        UsageMistake{"NotASection", set("terrain=4"), 1, {"--set terrain=4", "[terrain]"}},
        UsageMistake{"NoSuchStep", set("terrain.step.9.height=3"), 2, {"'9'"}},
        UsageMistake{"NoSuchSpecies", set("species.oak.models=3"), 2, {"'oak'"}},
        UsageMistake{"BelowAValue", set("terrain.size.x=3"), 2, {"terrain.size.x"}},
        UsageMistake{"WrongType", set("camera.look_height=abc"), 1, {"look_height", "a number"}},
        UsageMistake{"NoValue", set("terrain.size="), 1, {"terrain.size=", "a number"}},
        UsageMistake{"MissingFile", set("species.tree.plant=no.lsys"), 1, {"--set", "no.lsys"}},
        UsageMistake{"TooCoarse",
                     set("terrain.resolution=1"),
                     1,
                     {"--set terrain.resolution=1", "an integer, 2 to"}},
        UsageMistake{
            "TooFine", set("terrain.resolution=900000"), 1, {"TB", "a resolution of", "would fit"}},
        UsageMistake{"TooFineAround",
                     set("surroundings.resolution=90000"),
                     1,
                     {"surroundings.resolution", "16385"}}),
    [](const auto& test) { return test.param.name; });

TEST(Errors, ATerrainThatCannotFitIsNamedAtItsLine) {
  const Workplace place;
  std::string scene = testing::small_scene;
  scene.replace(scene.find("resolution = 65"), 15, "resolution = 999999");
  place.write("scene.toml", scene);
  const Words parts{"scene.toml:6:14: error: ", "TB", "would fit"};
  for (const char* command : {"check", "render", "terrain"})
    expect_one_line(place.run({command, "scene.toml"}), 1, parts);
}

TEST(Errors, APictureThatIsNoneIsNamedAtItsStepAndNothingIsWritten) {
  const Workplace place;
  place.write("nopicture.png", "this is a text");
  place.write("scene.toml", std::string(testing::small_scene) +
                                "[[terrain.step]]\nop = \"import\"\nfile = \"nopicture.png\"\n");
  const std::string before = place.files();
  const Words parts{"scene.toml:29:1: error: ", "'nopicture.png' is not a picture", "PNG"};
  expect_one_line(place.run({"render", "scene.toml", "-o", "x.png"}), 1, parts);
  expect_one_line(place.run({"terrain", "scene.toml", "-o", "x.exr"}), 1, parts);
  EXPECT_EQ(place.files(), before);
}

TEST(Errors, TheTerrainCommandChecksItsOutputsFirst) {
  const Workplace place;
  const std::string before = place.files();
  const auto terrain = [&](Words words) {
    words.insert(words.begin(), {"terrain", "scene.toml"});
    return place.run(words);
  };
  expect_one_line(terrain({"-o", "x.jpg"}), 2, {".jpg", ".exr"});
  expect_one_line(terrain({"-o", "no/x.exr"}), 1, {"'no' does not exist"});
  expect_one_line(terrain({"--preset", "unrael"}), 2, {"Did you mean 'unreal'?"});
  expect_one_line(terrain({"--preset", "unity", "-o", "x.png"}), 2, {".raw"});
  expect_one_line(terrain({"--preset", "unity", "--resolution", "100"}), 2, {"33, 65, 129"});
  expect_one_line(terrain({"--resolution", "1"}), 2, {"--resolution"});
  EXPECT_EQ(place.files(), before);
}

TEST(Errors, StreamsThatCannotBeWrittenDoNotCostThePicture) {
  const Workplace place;
  EXPECT_EQ(place.run({"render", "scene.toml", "-o", "a.png"}, "", "/dev/full").exit_code, 0);
  EXPECT_TRUE(place.has("a.png"));
  const Outcome outcome = place.run({"render", "scene.toml", "-o", "b.png", "--json"}, "/dev/full");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.err.find("cannot write to standard output"), std::string::npos);
  EXPECT_TRUE(place.has("b.png"));
}

}  // namespace
}  // namespace wold
