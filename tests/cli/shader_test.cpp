// `wold shader`: a scene's landscape as a file for Shadertoy, for a browser, or for one's own
// program.

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "image/io.hpp"
#include "process.hpp"

namespace wold {
namespace {

using nlohmann::json;
using testing::Outcome;
using testing::Workplace;
using Words = std::vector<std::string>;

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

constexpr int usage = 2;

void expect_one_line(const Outcome& outcome, int exit_code, const Words& parts) {
  EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  for (const std::string& part : parts)
    EXPECT_TRUE(has(outcome.err, part)) << "'" << part << "' is not in: " << outcome.err;
}

const char* const with_slides = R"(
[[terrain.step]]
name = "slides"
op = "thermal"
)";

class Shader : public ::testing::Test {
 protected:
  /// The report of a run with --json.
  json report(Words arguments) {
    arguments.insert(arguments.begin(), "shader");
    arguments.insert(arguments.end(), {"--json", "--quiet"});
    const Outcome done = place_.run(arguments);
    EXPECT_EQ(done.exit_code, 0) << done.err;
    return done.exit_code == 0 ? json::parse(done.out) : json::object();
  }

  Workplace place_;
};

TEST_F(Shader, EachTargetWritesItsFile) {
  struct Target {
    const char* name;
    const char* file;
    const char* begins;
    const char* holds;
  };
  for (const Target& target :
       {Target{"shadertoy", "scene.glsl", "// A landscape", "void mainImage("},
        Target{"glsl", "scene.frag", "#version 330 core", "void main()"},
        Target{"html", "scene.html", "<!DOCTYPE html>", "</html>"}}) {
    const json told = report({"scene.toml", "--target", target.name});
    EXPECT_EQ(told["file"], target.file);
    EXPECT_EQ(told["target"], target.name);
    const std::string text = place_.read(target.file);
    EXPECT_EQ(told["bytes"], text.size());
    EXPECT_TRUE(text.rfind(target.begins, 0) == 0) << text.substr(0, 80);
    EXPECT_TRUE(has(text, target.holds)) << target.name;
  }
}

TEST_F(Shader, KnobsComeFromSceneAndCommand) {
  const json told = report({"scene.toml", "-o", "a.glsl", "--define", "OCTAVES=7", "--define",
                            "CAM_HEIGHT=123", "--set", "sky.turbidity=3"});
  EXPECT_EQ(told["terrain"], "function");
  EXPECT_EQ(told["left_out"], json::array());
  const std::string text = place_.read("a.glsl");
  EXPECT_TRUE(has(text, "#define OCTAVES 7 "));
  EXPECT_TRUE(has(text, "#define CAM_HEIGHT 123.0 "));
}

TEST_F(Shader, StepsThatNeedTheWholeLandTravelAsAMapOrAreTold) {
  place_.write("scene.toml", std::string(testing::small_scene) + with_slides);
  const json page = report({"scene.toml", "--target", "html"});
  EXPECT_EQ(page["terrain"], "map");
  EXPECT_EQ(page["left_out"], json::array());
  EXPECT_TRUE(has(place_.read("scene.html"), "\"data\":"));
  const json tab = report({"scene.toml"});
  EXPECT_EQ(tab["terrain"], "function");
  EXPECT_EQ(tab["left_out"], json({"slides"}));

  const Outcome told = place_.run({"shader", "scene.toml"});
  EXPECT_EQ(told.exit_code, 0);
  EXPECT_TRUE(has(told.err, "left out, because they need the whole land: slides\n")) << told.err;
  EXPECT_TRUE(has(told.err, "wrote scene.glsl: shadertoy, ")) << told.err;
  expect_one_line(place_.run({"shader", "scene.toml", "--terrain", "map", "-o", "b.glsl"}), usage,
                  {"only --target html can carry the land as a map", "--terrain function"});
  EXPECT_FALSE(place_.has("b.glsl"));
}

TEST_F(Shader, AlsoDrawsWhatItWrote) {
  const json told = report({"scene.toml", "-o", "a.glsl", "--screenshot", "a.png", "--size",
                            "48x27", "--define", "LOW_QUALITY=1"});
  EXPECT_EQ(told["screenshot"], "a.png");
  const Image picture = read_picture(place_.path("a.png").string()).image;
  ASSERT_EQ(picture.width, 48);
  ASSERT_EQ(picture.height, 27);
  EXPECT_GT(picture.at(24, 2, 2), 0.2F);  // the sky by day
}

TEST_F(Shader, MistakesAreOneLineAndLeaveNoFile) {
  const std::string before = place_.files();
  const Words shader{"shader", "scene.toml"};
  struct Mistake {
    Words arguments;
    Words parts;
    int exit_code = usage;
  };
  for (const Mistake& m : {
           Mistake{{"--target", "shadertoi"}, {"'shadertoi'", "Did you mean 'shadertoy'?"}},
           Mistake{{"--define", "OCTAVE=7"}, {"no knob 'OCTAVE'", "Did you mean 'OCTAVES'?"}},
           Mistake{{"--define", "OCTAVES=99"}, {"OCTAVES", "99", "1 to 24"}},
           Mistake{{"--define", "OCTAVES"}, {"--define OCTAVES wants a value", "OCTAVES=10"}},
           Mistake{{"--terrain", "maps"}, {"auto, function or map", "'maps'"}},
           Mistake{{"--size", "big"}, {"--size", "640x360", "'big'"}},
           Mistake{{"--camera", "peak"}, {"'peak'"}},
           Mistake{{"--set", "sky.turbidty=3"}, {"turbidity"}, 1},
       }) {
    Words all = shader;
    all.insert(all.end(), m.arguments.begin(), m.arguments.end());
    expect_one_line(place_.run(all), m.exit_code, m.parts);
  }
  expect_one_line(place_.run({"shader", "scenery.toml"}), 1, {"scenery.toml"});
  EXPECT_EQ(place_.files(), before);
}

TEST_F(Shader, DisksAndFoldersThatTakeNothingAreToldOfByName) {
  expect_one_line(place_.run({"shader", "scene.toml", "-o", "nowhere/a.glsl", "--quiet"}), 1,
                  {"nowhere"});
  expect_one_line(place_.run({"shader", "scene.toml", "-o", "/dev/full", "--quiet"}), 1,
                  {"/dev/full"});
  const std::string before = place_.files();
  expect_one_line(place_.run_with_files_up_to(4096, {"shader", "scene.toml", "--quiet"}), 1,
                  {"scene.glsl"});
  EXPECT_EQ(place_.files(), before);
}

}  // namespace
}  // namespace wold
