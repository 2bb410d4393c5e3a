// The picture that the program writes: the same for any number of threads and any split of its
// samples, saved when interrupted.

#include <gtest/gtest.h>

#include <cmath>
#include <csignal>
#include <nlohmann/json.hpp>

#include "image/io.hpp"
#include "process.hpp"

namespace wold {
namespace {

using testing::Outcome;
using testing::Workplace;
using Words = std::vector<std::string>;

/// Several species of which one has a coat, undergrowth near the camera, haze.
constexpr const char* rich_additions = R"(
[[species]]
name = "bush"
plant = "tree.lsys"
height = [0.5, 1]
models = 3

[[species]]
name = "herb"
plant = "tree.lsys"
height = [0.1, 0.2]
models = 1
detail = 0.5

[[material]]
name = "bush.leaf"
color1 = [0.1, 0.2, 0.05]
transmission = [0.1, 0.2, 0.02]
roughness = 0.3

[[scatter]]
species = { bush = 1, tree = 0.2 }
density = 0.01
align = 0.5

[[scatter]]
species = { herb = 1 }
density = 4
within = 12

[sky]
visibility = 3000
)";

Workplace& rich(Workplace& place) {
  place.write("scene.toml", std::string(testing::small_scene) + rich_additions);
  return place;
}

Words render(const std::string& output, const Words& more = {}) {
  Words words{"render", "scene.toml", "-q", "-o", output};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

TEST(Render, SameFileForAnyNumberOfThreadsAndAgain) {
  Workplace place;
  rich(place);
  const Words resolution{"--set", "terrain.resolution=129"};
  const auto with_threads = [&](const std::string& name, const std::string& threads) {
    Words words = render(name, resolution);
    words.insert(words.end(), {"-o", name + ".png", "--threads", threads});
    EXPECT_EQ(place.run(words).exit_code, 0);
    return place.read(name) + place.read(name + ".png");
  };
  const std::string one = with_threads("one.exr", "1");
  ASSERT_GT(one.size(), 10000U);
  EXPECT_EQ(with_threads("again.exr", "1"), one);
  EXPECT_EQ(with_threads("two.exr", "2"), one);
  EXPECT_EQ(with_threads("four.exr", "4"), one);
}

TEST(Render, AnotherSeedIsAnotherPicture) {
  const Workplace place;
  place.run(render("a.exr"));
  place.run(render("b.exr", {"--seed", "4"}));
  place.run(render("c.exr", {"--seed", "3"}));
  EXPECT_NE(place.read("a.exr"), place.read("b.exr"));
  EXPECT_EQ(place.read("a.exr"), place.read("c.exr"));
}

TEST(Render, HalvesOfTheSamplesAverageToAll) {
  Workplace place;
  rich(place);
  const auto samples = [&](const char* name, const char* range) {
    EXPECT_EQ(place.run(render(name, {"--samples", range})).exit_code, 0);
    return read_picture(place.path(name).string()).image;
  };
  const Image all = samples("all.exr", "0:16");
  const Image first = samples("first.exr", "0:8");
  const Image second = samples("second.exr", "8:16");
  EXPECT_NE(first.pixels, second.pixels);
  for (const char* name : {"R", "G", "B", "A"}) {
    const int c = all.find(name);
    ASSERT_GE(c, 0);
    for (int y = 0; y < all.height; ++y)
      for (int x = 0; x < all.width; ++x) {
        const float mean = 0.5F * (first.at(x, y, c) + second.at(x, y, c));
        ASSERT_NEAR(all.at(x, y, c), mean, 1e-5F * std::abs(mean) + 1e-9F)
            << name << " at " << x << ", " << y;
      }
  }
  EXPECT_EQ(all.at(0, 0, all.find("samples")), 16);
}

TEST(Render, ExrHasItsLayersAndPngItsSize) {
  const Workplace place;
  EXPECT_EQ(place.run(render("a.exr", {"-o", "a.png", "--size", "64x36"})).exit_code, 0);
  const Picture exr = read_picture(place.path("a.exr").string());
  const Picture png = read_picture(place.path("a.png").string());
  for (const char* channel : {"R", "G", "B", "A", "albedo.R", "normal.Z", "depth.Z", "samples"})
    EXPECT_GE(exr.image.find(channel), 0) << channel;
  EXPECT_EQ(exr.metadata.at("wold.samples"), "0:4");
  EXPECT_EQ(exr.metadata.at("wold.seed"), "3");
  EXPECT_EQ(png.image.width, 64);
  EXPECT_EQ(png.image.height, 36);
  EXPECT_EQ(png.bits, 8);
  EXPECT_TRUE(png.srgb_tagged);
}

TEST(Render, APictureOfOnePixel) {
  const Workplace place;
  const Outcome outcome = place.run(render("a.png", {"--size", "1x1", "--samples", "1"}));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(read_picture(place.path("a.png").string()).image.width, 1);
}

TEST(Render, TheCoarsestTerrain) {
  const Workplace place;
  const Words coarse{"--set", "terrain.resolution=2", "--set", "surroundings.factor=1"};
  const Outcome outcome = place.run(render("a.png", coarse));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
}

TEST(Render, WithoutOutputThePictureIsNamedAfterTheScene) {
  const Workplace place;
  EXPECT_EQ(place.run({"render", "scene.toml", "-q"}).exit_code, 0);
  EXPECT_EQ(place.files(), "scene.png scene.toml tree.lsys");
}

TEST(Render, AnEmptySceneIsWhole) {
  const Workplace place;
  place.write("empty.toml", "");
  EXPECT_EQ(place.run({"check", "empty.toml"}).exit_code, 0);
  // The same defaults, but cheap.
  const Outcome outcome = place.run({"render",
                                     "empty.toml",
                                     "-q",
                                     "--size",
                                     "64x36",
                                     "--samples",
                                     "2",
                                     "--set",
                                     "terrain.resolution=129",
                                     "--set",
                                     "terrain.size=300",
                                     "--set",
                                     "scatter.2.density=0.2",
                                     "--set",
                                     "species.birch.models=1",
                                     "--set",
                                     "species.spruce.models=1",
                                     "--set",
                                     "species.oak.models=1",
                                     "--set",
                                     "species.birch.detail=0.2",
                                     "--set",
                                     "species.spruce.detail=0.2",
                                     "--set",
                                     "species.oak.detail=0.2"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(place.has("empty.png"));
}

class Interrupted : public ::testing::TestWithParam<int> {};

TEST_P(Interrupted, RenderSavesThePictureSoFar) {
  const Workplace place;
  const Words words{"render", "scene.toml", "-o", "a.exr", "-o", "a.png", "--samples", "1000000"};
  const Outcome outcome = place.interrupt(words, GetParam(), "[camera]", 1.5);
  EXPECT_EQ(outcome.exit_code, 130) << outcome.err;
  EXPECT_LT(outcome.seconds, 1);
  EXPECT_NE(outcome.err.find("the picture so far"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("a.exr and a.png"), std::string::npos) << outcome.err;
  EXPECT_EQ(place.files(), "a.exr a.png scene.toml tree.lsys");
  const Image exr = read_picture(place.path("a.exr").string()).image;
  EXPECT_EQ(exr.width, 96);
  EXPECT_GT(exr.at(48, 27, exr.find("samples")), 0);
  EXPECT_EQ(read_picture(place.path("a.png").string()).image.height, 54);
}

TEST_P(Interrupted, QuietRenderSavesItToo) {
  const Workplace place;
  const Words words{"render", "scene.toml", "-o", "a.png", "-q", "--json", "--samples", "1000000"};
  const Outcome outcome = place.interrupt(words, GetParam(), "", 3);
  EXPECT_EQ(outcome.exit_code, 130) << outcome.err;
  EXPECT_LT(outcome.seconds, 1);
  EXPECT_TRUE(place.has("a.png"));
  EXPECT_NE(outcome.err.find("the picture so far"), std::string::npos) << outcome.err;
  const auto report = nlohmann::json::parse(outcome.out);
  EXPECT_FALSE(report["complete"].get<bool>());
  EXPECT_GT(report["paths"].get<double>(), 0);
}

TEST_P(Interrupted, BuildingASceneLeavesNothing) {
  const Workplace place;
  const std::string before = place.files();
  // Each takes many seconds in another stage.
  const std::vector<Words> slow{
      {"--set", "terrain.resolution=9000", "--set", "terrain.step.fbm.octaves=24"},
      {"--set", "scatter.density=40"},
      {"--set", "species.models=60", "--set", "species.plant=" WOLD_SOURCE_DIR "/plants/oak.lsys"},
      {"--set", "render.dicing=0.25", "--size", "3000x2000"}};
  for (const Words& settings : slow) {
    Words words{"render", "scene.toml", "-o", "a.png"};
    words.insert(words.end(), settings.begin(), settings.end());
    const Outcome outcome = place.interrupt(words, GetParam(), "", 0.7);
    EXPECT_EQ(outcome.exit_code, 130) << settings[1] << outcome.err;
    EXPECT_LT(outcome.seconds, 1.5) << settings[1];
    EXPECT_NE(outcome.err.find("interrupted; nothing was written"), std::string::npos)
        << settings[1] << outcome.err;
    EXPECT_EQ(place.files(), before) << settings[1];
  }
}

INSTANTIATE_TEST_SUITE_P(By, Interrupted, ::testing::Values(SIGINT, SIGTERM),
                         [](const auto& test) { return test.param == SIGINT ? "INT" : "TERM"; });

}  // namespace
}  // namespace wold
