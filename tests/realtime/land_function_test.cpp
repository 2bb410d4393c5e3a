#include "realtime/land_function.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "gpu/context.hpp"
#include "gpu/evaluate.hpp"
#include "scene/build.hpp"
#include "scene/scene.hpp"

namespace wold {
namespace {

/// A scene of 2 km with the steps of a text.
Scene scene_of(const std::string& steps) {
  return parse_scene("[terrain]\nsize = 2000\nresolution = 65\ncenter = [700, -1300]\n" + steps,
                     "test.toml", {});
}

LandFunction function_of(const Scene& scene) {
  return land_function(scene.terrain, scene.steps, scene_operators(), scene.header.seed);
}

/// Largest difference between GLSL's land and the evaluated terrain, over its range of heights.
/// Samples near the border are passed over: there warps look beyond it. `gradient` instead compares
/// slopes with central differences, over the steepest.
struct Difference {
  double height = 0;
  double slope = 0;
};
Difference difference(const Scene& scene) {
  const LandFunction land = function_of(scene);
  EXPECT_TRUE(land.left_out.empty());
  Progress progress;
  const Heightfield field = build_terrain(scene, progress).field;
  const DVec2 middle = domain_of(scene.terrain).center();
  std::vector<Vec4> places;
  std::vector<IVec2> samples;
  for (int j = 2; j < field.height.height() - 2; j += 3)
    for (int i = 2; i < field.height.width() - 2; i += 3) {
      const DVec2 at = field.origin + field.cell * DVec2(i, j) - middle;
      places.emplace_back(at.x, at.y, field.cell, 0);
      samples.emplace_back(i, j);
    }
  const std::vector<Vec4> told =
      evaluate_shader("#define SMOOTH_RIDGES 1.0\n" + land.text +
                          "vec4 evaluate(vec4 a, vec4 b) { return vec4(land(a.xy, a.z), 0.0); }",
                      places);
  const auto [low, high] =
      std::minmax_element(field.height.values().begin(), field.height.values().end());
  const double range = std::max(1.0, double{*high - *low});
  Difference worst;
  double steepest = 0.1;
  for (std::size_t k = 0; k < told.size(); ++k) {
    const IVec2 s = samples[k];
    worst.height =
        std::max(worst.height, std::abs(double{told[k].x - field.height(s.x, s.y)}) / range);
    const float east = (field.height(s.x + 1, s.y) - field.height(s.x - 1, s.y)) /
                       static_cast<float>(2 * field.cell);
    const float north = (field.height(s.x, s.y + 1) - field.height(s.x, s.y - 1)) /
                        static_cast<float>(2 * field.cell);
    steepest = std::max({steepest, std::abs(double{east}), std::abs(double{north})});
    worst.slope += std::hypot(double{told[k].y - east}, double{told[k].z - north});
  }
  worst.slope /= static_cast<double>(told.size()) * steepest;
  return worst;
}

class Land : public testing::Test {
 protected:
  OffscreenContext context_;
};

std::string step(const std::string& text) {
  return "[[terrain.step]]\n" + text + "\n";
}

struct Case {
  const char* name;
  std::string steps;
  double tolerance;  // of the range of heights
};

const std::string hills = step("op = \"fbm\"\nheight = 300\nfeature_size = 900\noctaves = 6");

// Fractals and what is done with heights: to rounding. Warps and masks by slope read the samples
// of a grid in C++ (bicubic, differences), so they differ by what lies between samples.
std::vector<Case> cases() {
  constexpr double rounding = 5e-5;
  constexpr double between_samples = 4e-2;
  return {
      {"fbm", hills, rounding},
      {"ridged", step("op = \"ridged\""), rounding},
      {"hybrid", step("op = \"hybrid\""), rounding},
      {"turbulence", step("op = \"turbulence\""), rounding},
      {"eroded_noise", step("op = \"eroded_noise\""), 2e-2},
      {"constant", hills + step("op = \"constant\"\nheight = 70"), rounding},
      {"plane", hills + step("op = \"plane\"\nslope = 8\ndownhill = 30"), rounding},
      {"scale", hills + step("op = \"scale\"\nfactor = 1.5\noffset = -40"), rounding},
      {"remap", hills + step("op = \"remap\"\nfrom = [0, 300]\nto = [200, 50]"), rounding},
      {"clamp", hills + step("op = \"clamp\"\nrange = [60, 220]\nsoftness = 30"), rounding},
      {"smooth_floor", hills + step("op = \"smooth_floor\"\nlevel = 120"), rounding},
      {"power", hills + step("op = \"power\"\nrange = [0, 300]\nexponent = 2"), rounding},
      {"terrace", hills + step("op = \"terrace\""), 2e-3},
      {"falloff", hills + step("op = \"falloff\""), 1e-4},
      {"square_falloff", hills + step("op = \"falloff\"\nshape = \"square\"\nwidth = 400"), 1e-4},
      {"warp", hills + step("op = \"warp\""), between_samples},
      {"subtract", hills + step("op = \"ridged\"\nblend = \"subtract\""), rounding},
      {"multiply", hills + step("op = \"constant\"\nheight = 0.5\nblend = \"multiply\""), rounding},
      {"max", hills + step("op = \"constant\"\nheight = 150\nblend = \"max\""), rounding},
      {"min", hills + step("op = \"constant\"\nheight = 150\nblend = \"min\""), rounding},
      {"opacity", hills + step("op = \"ridged\"\nopacity = 0.3"), rounding},
      {"height_mask", hills + step("op = \"ridged\"\nmask_height = [150, 400]"), 1e-4},
      {"slope_mask",
       step("op = \"fbm\"\nheight = 300\nfeature_size = 900\noctaves = 2") +
           step("op = \"ridged\"\nheight = 200\noctaves = 3\nmask_slope = [15, 90]"),
       between_samples},
      {"named_mask",
       hills + step("name = \"m\"\nop = \"mask\"\nfrom = \"noise\"\nfeature_size = 700") +
           step("op = \"ridged\"\nmask = \"m\""),
       1e-3},
      {"inverted_mask",
       hills +
           step("name = \"m\"\nop = \"mask\"\nfrom = \"height\"\nheight = [100, 9000]\ninvert = "
                "true") +
           step("op = \"ridged\"\nmask = \"m\"\nmask_invert = true"),
       1e-4},
      {"combine",
       step("name = \"a\"\nop = \"fbm\"\nheight = 300") +
           step("name = \"b\"\nop = \"ridged\"\nblend = \"replace\"") +
           step("op = \"combine\"\nwith = \"a\"\nmethod = \"smooth_max\""),
       rounding},
      {"input",
       step("name = \"a\"\nop = \"fbm\"\nheight = 300") + step("op = \"ridged\"") +
           step("op = \"scale\"\ninput = \"a\"\nfactor = 2"),
       rounding},
  };
}

TEST_F(Land, IsTheTerrainOfCpp) {
  for (const Case& c : cases()) {
    const Difference d = difference(scene_of(c.steps));
    EXPECT_LE(d.height, c.tolerance) << c.name;
    EXPECT_LE(d.slope, 0.25) << c.name;  // of the steepest: differences span two samples
    RecordProperty(c.name, std::to_string(d.height));
  }
}

TEST(LandFunction, EveryOperatorIsToldOrLeftOut) {
  for (const TerrainOperator& op : scene_operators()) {
    TerrainStep made = make_step(scene_operators(), op.name());
    if (op.name() == "combine" || op.name() == "remap") continue;
    const LandFunction land =
        land_function({}, std::vector<TerrainStep>{made}, scene_operators(), 1);
    const bool told = land.text.find("ground_1") != std::string::npos;
    EXPECT_EQ(told, land.left_out.empty() && op.name() != "mask") << op.name();
  }
}

TEST(LandFunction, WhatRefersToAStepLeftOutIsLeftOutToo) {
  const Scene scene =
      scene_of(hills + step("name = \"soft\"\nop = \"blur\"") +
               step("op = \"combine\"\nwith = \"soft\"") + step("op = \"scale\"\nfactor = 2"));
  const LandFunction land = function_of(scene);
  EXPECT_EQ(land.left_out, (std::vector<std::string>{"soft", "combine"}));
  EXPECT_NE(land.text.find("scale"), std::string::npos);
}

TEST(LandFunction, NumbersAreFloatsOfGlsl) {
  EXPECT_EQ(glsl_number(3), "3.0");
  EXPECT_EQ(glsl_number(-0.25), "-0.25");
  EXPECT_EQ(glsl_number(1e-7), "1e-07");
}

}  // namespace
}  // namespace wold
