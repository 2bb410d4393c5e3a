#include "realtime/export.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "gpu/context.hpp"
#include "realtime/landscape_picture.hpp"
#include "realtime/packing.hpp"
#include "scene/scene.hpp"

namespace wold {
namespace {

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// Mountains with all that the shader shows, drawn with few steps.
Landscape mountains(const LandscapeOptions& options = {}) {
  const Scene scene = read_scene(std::filesystem::path(WOLD_SOURCE_DIR) / "scenes/mountains.toml",
                                 std::vector<std::string>{"terrain.resolution=129"});
  Progress progress;
  Landscape landscape = landscape_of(scene, options, progress);
  for (const char* knob :
       {"MAX_MARCHING_STEPS=120", "CLOUD_STEPS=16", "CLOUD_LIGHT_STEPS=3", "OCTAVES_NORMAL=11",
        "MAX_MARCHING_STEPS_SHADOW=16", "FILTERING_SAMPLES=1", "CLOUD_COVERAGE=0.5"})
    set_knob(landscape.settings, knob);
  return landscape;
}

double psnr(const Image& a, const Image& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.pixels.size(); ++k)
    sum += std::pow(static_cast<double>(a.pixels[k] - b.pixels[k]), 2);
  return sum == 0 ? 99 : -10 * std::log10(sum / static_cast<double>(a.pixels.size()));
}

std::string shadertoy_wrapped(const std::string& tab) {
  return "#version 300 es\nprecision highp float;\nprecision highp int;\n"
         "uniform vec3 iResolution;\nuniform float iTime;\nuniform vec4 iMouse;\nout vec4 "
         "shown;\n" +
         tab + "\nvoid main() {\n  mainImage(shown, gl_FragCoord.xy);\n}\n";
}

/// 0 if the reference compiler takes it.
int validated(const std::string& text, const std::string& name) {
  const std::string path = testing::TempDir() + name;
  std::ofstream(path) << text;
  return std::system(("glslangValidator " + path + " > " + path + ".log").c_str());
}

TEST(Export, CompilesByTheReferenceCompiler) {
  const Landscape landscape = mountains();
  EXPECT_EQ(validated(shadertoy_wrapped(export_shader(landscape, ShaderTarget::shadertoy)),
                      "shadertoy.frag"),
            0);
  EXPECT_EQ(validated(export_shader(landscape, ShaderTarget::glsl), "plain.frag"), 0);
  Landscape low = landscape;
  low.settings.low_quality = true;
  EXPECT_EQ(validated(shadertoy_wrapped(export_shader(low, ShaderTarget::shadertoy)), "low.frag"),
            0);
}

TEST(Export, HasEveryKnobByName) {
  const std::string tab = export_shader(mountains(), ShaderTarget::shadertoy);
  for (const char* knob : {"MAX_RENDERING_DISTANCE",
                           "MAX_MARCHING_STEPS",
                           "MAX_MARCHING_STEPS_SHADOW",
                           "TEXTURE_LOW_QUALITY",
                           "TEXTURE_FILTERING",
                           "FILTERING_SAMPLES",
                           "ATMOS_STEPS",
                           "ATMOS_LIGHT_STEPS",
                           "CLOUD_STEPS",
                           "CLOUD_LIGHT_STEPS",
                           "CLOUD_COVERAGE",
                           "OCTAVES",
                           "OCTAVES_SHADOW",
                           "OCTAVES_NORMAL",
                           "SMOOTH_RIDGES",
                           "CLOUDS_HEIGHT",
                           "CLOUDS_THICKNESS",
                           "CAM_HEIGHT",
                           "CAM_SPEED",
                           "SUN_ELEVATION",
                           "SUN_AZIMUTH",
                           "TERRAIN_HEIGHT",
                           "TERRAIN_SCALE",
                           "CLOUD_SCATTERING",
                           "CLOUD_ABSORPTION",
                           "CLOUD_DENSITY",
                           "CLOUD_FORWARD",
                           "CLOUD_BACK",
                           "LOW_QUALITY"})
    EXPECT_TRUE(has(tab, std::string("#define ") + knob + " ")) << knob;
  EXPECT_FALSE(has(tab, "#include"));
  EXPECT_FALSE(has(tab, "#version"));
}

TEST(Export, ThePageIsAlone) {
  const std::string page = export_shader(mountains(), ShaderTarget::html);
  for (const char* part : {"http:", "https:", "%%", "#include"})
    EXPECT_FALSE(has(page, part)) << part;
  EXPECT_TRUE(has(page, "uniform float sun_elevation;"));
}

TEST(Export, AMapTravelsInPagesOnly) {
  const Landscape landscape = mountains({.source = LandSource::map});
  ASSERT_TRUE(landscape.map);
  EXPECT_TRUE(has(export_shader(landscape, ShaderTarget::html), "\"data\":"));
  EXPECT_THROW(export_shader(landscape, ShaderTarget::shadertoy), Error);
  const HeightMap& map = landscape.map->heights;
  const std::string text = packed(map.samples, map.width);
  EXPECT_EQ(unpacked_words(text, map.width, map.height), map.samples);
  EXPECT_THROW(unpacked_words(text, map.width, map.height + 1), Error);
}

TEST(Export, DrawsInEs3WhatTheFilesDraw) {
  const OffscreenContext context({.es = true});
  const Landscape landscape = mountains();
  const LandscapeDrawing from_files(landscape);
  const LandscapeDrawing from_export(export_shader(landscape, ShaderTarget::shadertoy), {});
  const Image files = landscape_picture(from_files, 96, 54, 3);
  const Image exported = landscape_picture(from_export, 96, 54, 3);
  EXPECT_GE(psnr(files, exported), 40);
  EXPECT_GT(files.at(48, 2, 2), 0.3F);  // light above
}

TEST(Export, LowQualityDrawsAnotherPicture) {
  const OffscreenContext context;
  Landscape landscape = mountains();
  const Image normal = landscape_picture(LandscapeDrawing(landscape), 64, 36, 0);
  landscape.settings.low_quality = true;
  const Image low = landscape_picture(LandscapeDrawing(landscape), 64, 36, 0);
  EXPECT_LT(psnr(normal, low), 40);
  EXPECT_GT(psnr(normal, low), 10);
}

TEST(Export, TreesStandWhereTheKnobSays) {
  const OffscreenContext context;
  const Scene scene = read_scene(std::filesystem::path(WOLD_SOURCE_DIR) / "scenes/forest.toml",
                                 std::vector<std::string>{"terrain.resolution=65"});
  Progress progress;
  Landscape landscape = landscape_of(scene, {}, progress);
  landscape.settings.low_quality = true;
  landscape.settings.cam_tilt = -40;
  const auto green_over_red = [&](float trees) {
    landscape.settings.trees = trees;
    const Image picture = landscape_picture(LandscapeDrawing(landscape), 32, 18, 0);
    double green = 0;
    double red = 0;
    for (int y = 0; y < picture.height; ++y)
      for (int x = 0; x < picture.width; ++x) {
        red += double{picture.at(x, y, 0)};
        green += double{picture.at(x, y, 1)};
      }
    return green / red;
  };
  EXPECT_GT(green_over_red(1), 1.1 * green_over_red(0));
}

TEST(Export, AShaderThatFailsTellsFileAndLine) {
  const OffscreenContext context;
  Landscape landscape = mountains();
  for (LandscapeValue& v : landscape.values)
    if (v.name == "HIGHEST_LAND") v.value = "3.0 3.0";
  try {
    landscape_picture(LandscapeDrawing(landscape), 8, 8, 0);
    FAIL();
  } catch (const Error& error) {
    EXPECT_TRUE(has(error.message(), "landscape/terrain.glsl:")) << error.message();
  }
}

TEST(Knobs, AreCheckedByNameAndRange) {
  LandscapeSettings s;
  set_knob(s, "OCTAVES=7");
  set_knob(s, "CLOUD_COVERAGE=0.75");
  set_knob(s, "TEXTURE_FILTERING=0");
  EXPECT_EQ(s.octaves, 7);
  EXPECT_EQ(s.cloud_coverage, 0.75F);
  EXPECT_FALSE(s.texture_filtering);
  for (const char* wrong : {"OCTAVE=7", "OCTAVES", "OCTAVES=", "OCTAVES=2.5", "OCTAVES=99",
                            "CLOUD_COVERAGE=x", "TEXTURE_FILTERING=2", "EXPOSURE=nan"})
    EXPECT_THROW(set_knob(s, wrong), Error) << wrong;
  try {
    set_knob(s, "OCTAVE=7");
    FAIL();
  } catch (const Error& error) {
    EXPECT_TRUE(has(error.message(), "OCTAVES"));
  }
}

TEST(Landscapes, TellWhatTheyLeaveOut) {
  Progress progress;
  const Scene scene =
      parse_scene("[[terrain.step]]\nop = \"fbm\"\n[[terrain.step]]\nop = \"thermal\"\n", "a.toml",
                  {}, std::vector<std::string>{"terrain.resolution=65"});
  EXPECT_FALSE(is_function(scene));
  EXPECT_EQ(landscape_of(scene, {}, progress).left_out, std::vector<std::string>{"thermal"});
}

}  // namespace
}  // namespace wold
