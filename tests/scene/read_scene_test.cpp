#include <gtest/gtest.h>

#include "scene/build.hpp"
#include "scene/scene.hpp"

namespace wold {
namespace {

const char* const text = R"(wold = 1
seed = 9
[terrain]
size = 1000
[[terrain.step]]
op = "fbm"
height = 50
[[terrain.step]]
op = "ridged"
name = "peaks"
octaves = 3
[[species]]
name = "birch"
plant = "plants/birch.lsys"
height = [3, 4]
[[species]]
name = "fern"
plant = "plants/fern.lsys"
[[scatter]]
species = { birch = 3, fern = 1 }
[sky]
time = 2026-06-21T18:30:00+02:00
[[camera]]
name = "first"
[[camera]]
name = "second"
position = [1, 2]
[render]
size = [64, 36]
)";

Scene read(const std::vector<std::string>& overrides = {}, const std::string& source = text) {
  return parse_scene(source, "scene.toml", WOLD_SOURCE_DIR "/scenes", overrides);
}

std::string error_of(const std::vector<std::string>& overrides, const std::string& source = text) {
  try {
    check_scene(read(overrides, source));
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(ReadScene, TakesEverySection) {
  const Scene scene = read();
  EXPECT_EQ(scene.header.seed, 9U);
  EXPECT_EQ(scene.terrain.size, 1000);
  ASSERT_EQ(scene.steps.size(), 2U);
  EXPECT_EQ(scene.steps[1].op, "ridged");
  EXPECT_EQ(scene.steps[1].settings.name, "peaks");
  ASSERT_EQ(scene.species.size(), 2U);
  EXPECT_EQ(scene.species[0].height, (Range{3, 4}));
  ASSERT_EQ(scene.scatter.size(), 1U);
  EXPECT_EQ(scene.scatter[0].species.size(), 2U);
  EXPECT_EQ(scene.sky.time.offset_minutes, 120);
  EXPECT_EQ(scene.cameras.size(), 2U);
  EXPECT_EQ(scene.camera("").name, "first");
  EXPECT_EQ(scene.camera("second").position.size(), 2U);
  EXPECT_THROW(scene.camera("third"), Error);
  EXPECT_EQ(scene.render.size, IVec2(64, 36));
}

TEST(ReadScene, KnowsWhereThingsStand) {
  const Scene scene = read();
  EXPECT_EQ(scene.location("terrain.size").text(), "scene.toml:4:8");
  EXPECT_EQ(scene.location("species.1.plant").text(), "scene.toml:18:9");
  EXPECT_EQ(scene.location("species.1.height").line, 16);
  EXPECT_EQ(scene.location("surroundings.resolution").text(), "scene.toml");
}

TEST(ReadScene, AnEmptyFileIsALandWithAForest) {
  const Scene scene = read({}, "");
  EXPECT_FALSE(scene.steps.empty());
  EXPECT_FALSE(scene.species.empty());
  EXPECT_FALSE(scene.scatter.empty());
  EXPECT_EQ(scene.cameras.size(), 1U);
  EXPECT_NO_THROW(check_scene(scene));
}

TEST(ReadScene, OverridesReachEverything) {
  const Scene scene =
      read({"terrain.size=2000", "terrain.step.ridged.octaves=7", "terrain.step.peaks.opacity=0.5",
            "terrain.step.0.height=77", "species.birch.models=2", "species.1.height=[1, 2]",
            "camera.look_height=3", "camera.second.look_height=4", "sky.place=[10, 20]",
            "sky.time=2026-01-01T12:00:00Z", "scatter.density=0.5", "seed=11",
            "picture.tone_map=agx", "surroundings.factor=2"});
  EXPECT_EQ(scene.terrain.size, 2000);
  EXPECT_EQ(std::get<std::int64_t>(scene.steps[1].parameters.parameters().find("octaves")->get(
                scene.steps[1].parameters.data())),
            7);
  EXPECT_EQ(scene.steps[1].settings.opacity, 0.5F);
  EXPECT_EQ(scene.species[0].models, 2);
  EXPECT_EQ(scene.species[1].height, (Range{1, 2}));
  EXPECT_EQ(scene.cameras[0].look_height, 3);
  EXPECT_EQ(scene.cameras[1].look_height, 4);
  EXPECT_EQ(scene.sky.place, DVec2(10, 20));
  EXPECT_EQ(scene.sky.time.month, 1);
  EXPECT_EQ(scene.scatter[0].density, 0.5);
  EXPECT_EQ(scene.header.seed, 11U);
  EXPECT_EQ(scene.surroundings.factor, 2);
}

TEST(ReadScene, OverridesReachDefaultStepsAndPlants) {
  const Scene scene = read({"terrain.step.0.height=5", "species.birch.models=1"}, "");
  EXPECT_EQ(scene.species[0].models, 1);
}

TEST(ReadScene, LaterOverridesWin) {
  EXPECT_EQ(read({"terrain.size=2000", "terrain.size=3000"}).terrain.size, 3000);
}

TEST(ReadScene, ErrorsNameTheOverride) {
  EXPECT_EQ(error_of({"terrain.sizee=3"}),
            "--set terrain.sizee=3: unknown parameter 'sizee' in 'terrain'. Did you mean 'size'?");
  EXPECT_EQ(
      error_of({"species.birch.plant=no.lsys"}).rfind("--set species.birch.plant=no.lsys: ", 0),
      0U);
}

TEST(ReadScene, RefusesAFormatOfTheFuture) {
  EXPECT_NE(error_of({}, "wold = 2\n").find("format 2"), std::string::npos);
}

TEST(ReadScene, RefusesListsThatMixKinds) {
  EXPECT_EQ(error_of({}, "[sky]\nplace = [1, \"a\"]\n").rfind("scene.toml:2:", 0), 0U);
  EXPECT_EQ(error_of({}, "[sky]\nplace = [[1, 2], 3]\n").rfind("scene.toml:2:", 0), 0U);
  EXPECT_EQ(error_of({}, "sky = 3\n").rfind("scene.toml:1:", 0), 0U);
  EXPECT_EQ(error_of({}, "species = [1, 2]\n").rfind("scene.toml:1:", 0), 0U);
}

TEST(ReadScene, WhatCannotFitIsRefusedBeforeTheWork) {
  EXPECT_EQ(error_of({"terrain.resolution=2000000"}).rfind("--set terrain.resolution=2000000: ", 0),
            0U);
}

TEST(ReadScene, EverySectionHasTheDefaultsOfItsStruct) {
  // Assigning every default to itself succeeds: no default lies outside its own limits.
  for (const SceneSection& section : scene_sections()) {
    Described copy = section.defaults;
    for (const Parameter& p : section.defaults.parameters().parameters) {
      const Value value = p.get(section.defaults.data());
      const bool unset = (p.kind == ParameterKind::numbers && p.max_items == 0) ||
                         p.kind == ParameterKind::weights || p.kind == ParameterKind::texts;
      if (!unset) {
        EXPECT_NO_THROW(copy.assign(p.name, value)) << section.path << '.' << p.name;
      }
      EXPECT_FALSE(p.text.empty()) << section.path << '.' << p.name;
    }
  }
}

}  // namespace
}  // namespace wold
