// `wold view` without a window, as a user runs it.

#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <nlohmann/json.hpp>

#include "image/io.hpp"
#include "process.hpp"

namespace wold {
namespace {

using testing::Outcome;
using testing::Workplace;
using Words = std::vector<std::string>;

TEST(View, WritesAPictureAndTellsHowFastItWas) {
  const Workplace place;
  const Outcome run = place.run({"view", "scene.toml", "--screenshot", "still.png", "--samples",
                                 "2", "--quality", "low", "--json", "--quiet"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE(run.err.empty()) << run.err;
  const auto report = nlohmann::json::parse(run.out);
  EXPECT_EQ(report["frames"], 2);
  EXPECT_EQ(report["outputs"][0], "still.png");
  EXPECT_GT(report["milliseconds"]["median"], 0);
  EXPECT_GT(report["triangles"], 100);
  const Picture picture = read_picture(place.path("still.png").string());
  EXPECT_EQ(picture.image.width, 96);
  // Sky above, land below.
  const auto blue_over_red = [&](int y) {
    return picture.image.at(48, y, 2) / std::max(picture.image.at(48, y, 0), 1e-3F);
  };
  EXPECT_GT(blue_over_red(2), 1.05F * blue_over_red(51));
}

TEST(View, KeepsThePictureSoFarWhenInterrupted) {
  const Workplace place;
  const Outcome run = place.interrupt(
      {"view", "scene.toml", "--screenshot", "still.png", "--samples", "60000", "--quality", "low"},
      SIGINT, "drawing");
  EXPECT_EQ(run.exit_code, 130) << run.err;
  EXPECT_NE(run.err.find("is in still.png"), std::string::npos) << run.err;
  EXPECT_EQ(read_picture(place.path("still.png").string()).image.width, 96);
}

TEST(View, FliesARecordedSession) {
  const Workplace place;
  place.write("session.txt", "wold recording 1\n0.1 held=forward\n0.1 held=forward\n");
  const Outcome run =
      place.run({"view", "scene.toml", "--replay", "session.txt", "--quality", "low", "--json"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(nlohmann::json::parse(run.out)["frames"], 2);
}

TEST(View, MakesAFilmAndOnlyTheFramesAskedFor) {
  const Workplace place;
  place.write("path.toml",
              "[[key]]\ntime = 0\nposition = [0, 0, 90]\nlook_direction = [0, 1, -0.2]\n"
              "[[key]]\ntime = 1\nposition = [0, 20, 90]\nlook_direction = [0, 1, -0.2]\n");
  const Outcome run =
      place.run({"view", "scene.toml", "--path", "path.toml", "--fps", "4", "--frames", "1:3", "-o",
                 "f_%02d.png", "--samples", "1", "--quality", "low"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(place.files(), "f_01.png f_02.png path.toml scene.toml tree.lsys");
}

TEST(View, DrawsAStillByTheShader) {
  const Workplace place;
  const Outcome run = place.run({"view", "scene.toml", "--renderer", "shader", "--define",
                                 "CLOUD_STEPS=8", "--screenshot", "still.png", "--samples", "2",
                                 "--quality", "low", "--json", "--quiet"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto report = nlohmann::json::parse(run.out);
  EXPECT_EQ(report["frames"], 5);
  EXPECT_EQ(read_picture(place.path("still.png").string()).image.width, 96);
}

struct Mistake {
  const char* name;
  Words words;
  int code;
  std::vector<std::string> told;
};

class ViewMistakes : public ::testing::TestWithParam<Mistake> {};

TEST_P(ViewMistakes, AreToldInOneLine) {
  const Workplace place;
  place.write("bad.toml", "[[key]]\ntime = 0\npositon = [0, 0, 9]\n");
  place.write("bad.txt", "wold recording 1\n0.1 held=forwards\n");
  Words words{"view", "scene.toml"};
  words.insert(words.end(), GetParam().words.begin(), GetParam().words.end());
  const Outcome run = place.run(words);
  EXPECT_EQ(run.exit_code, GetParam().code) << run.err;
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  for (const std::string& part : GetParam().told)
    EXPECT_NE(run.err.find(part), std::string::npos) << run.err;
}

INSTANTIATE_TEST_SUITE_P(
    CommandLine, ViewMistakes,
    ::testing::Values(
        Mistake{"Camera", {"--screenshot", "a.png", "--camera", "mian"}, 2, {"'main'"}},
        Mistake{"Picture", {"--screenshot", "a.jpeg"}, 2, {".png"}},
        Mistake{"Size", {"--screenshot", "a.png", "--size", "12"}, 2, {"1280x720"}},
        Mistake{"Quality", {"--quality", "best"}, 2, {"low", "high"}},
        Mistake{"Path", {"--path", "bad.toml"}, 1, {"bad.toml:3:1", "'position'"}},
        Mistake{"NoPath", {"--path", "none.toml"}, 1, {"none.toml"}},
        Mistake{"Pattern", {"--path", "bad.toml", "-o", "frame.png"}, 2, {"%04d"}},
        Mistake{"Recording", {"--replay", "bad.txt"}, 1, {"bad.txt:2", "'forward'"}},
        Mistake{"Renderer", {"--renderer", "painted"}, 2, {"drawn", "shader", "traced"}},
        Mistake{"TracedStill", {"--renderer", "traced", "--frames", "1"}, 2, {"--path", "P "}},
        Mistake{"ShaderAsExr", {"--renderer", "shader", "--screenshot", "a.exr"}, 2, {".png"}},
        Mistake{"Knob", {"--renderer", "shader", "--define", "OCTAVE=3"}, 2, {"'OCTAVES'"}},
        Mistake{"KnobUnused", {"--frames", "1", "--define", "OCTAVES=3"}, 2, {"--renderer shader"}},
        Mistake{"NoDesktop", {}, 1, {"DISPLAY", "--screenshot"}}),
    [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace wold
