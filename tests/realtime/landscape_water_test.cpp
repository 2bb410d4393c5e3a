#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "gpu/context.hpp"
#include "image/color.hpp"
#include "realtime/fast_landscape.hpp"
#include "realtime/landscape_picture.hpp"
#include "scene/scene.hpp"

namespace wold {
namespace {

/// A round lake 1.6 km across whose level is at 0, in land that rises gently around.
Landscape lake(const std::string& water, float bed = -20) {
  const Scene scene = parse_scene(
      "[terrain]\nsize = 4000\nresolution = 129\n[ground]\nsoil_color1 = [0.5, 0.5, 0.5]\n"
      "soil_color2 = [0.5, 0.5, 0.5]\ngrass_color1 = [0.5, 0.5, 0.5]\n"
      "grass_color2 = [0.5, 0.5, 0.5]\nrock_slope = [80, 85]\n[water]\n" +
          water,
      "lake.toml", {});
  Heightfield field{Grid<float>(129, 129), DVec2(-2000), 4000.0 / 128};
  Grid<float> depth(129, 129);
  for (int j = 0; j < 129; ++j)
    for (int i = 0; i < 129; ++i) {
      const DVec2 place = field.origin + field.cell * DVec2(i, j);
      const auto away = static_cast<float>(glm::length(place));
      field.height(i, j) = away < 800 ? bed : 0.02F * (away - 800) + 1;
      depth(i, j) = std::max(0.0F, -field.height(i, j));
    }
  GroundDressing dressing;
  dressing.water = scene.water;
  dressing.inner_water = WaterLayer(field, depth, 0.05F);
  const std::map<std::string, Grid<float>> maps;
  LandscapeOptions options;
  options.source = LandSource::map;
  options.finished.emplace(FinishedLand{field, maps, dressing});
  Progress progress;
  Landscape landscape = landscape_of(scene, options, progress);
  landscape.settings.trees = 0;
  landscape.settings.cloud_coverage = 0;
  landscape.settings.cloud_steps = 0;
  landscape.settings.max_rendering_distance = 20000;
  return landscape;
}

Camera looking(Vec3 from, Vec3 towards, float field_of_view) {
  Camera camera;
  camera.position = from;
  camera.direction = glm::normalize(towards);
  camera.up = std::abs(camera.direction.z) > 0.9F ? Vec3(0, 1, 0) : Vec3(0, 0, 1);
  camera.field_of_view = field_of_view;
  return camera;
}

/// What was shown as 1 - exp(-x) in sRGB.
float light(const Image& image, int x, int y, int channel) {
  return -std::log(1 - std::min(srgb_to_linear(image.at(x, y, channel)), 0.9999F));
}

TEST(LandscapeWater, MirrorsTheSkyByFresnel) {
  const OffscreenContext context;
  const Landscape landscape = lake("color = [0, 0, 0]\nripples = 0\nclarity = 0.001\n");
  constexpr int size = 128;
  const Camera camera = looking({0, -500, 30}, {0, 1, 0}, 30);
  const Image image = landscape_picture(LandscapeDrawing(landscape), size, size, 0, &camera, 1);
  int rows = 0;
  for (int below = 20; below < 60; below += 5) {
    const float p = (static_cast<float>(below) + 0.5F) / (0.5F * size);
    const float sine = std::sin(std::atan(p * std::tan(radians(15.0F))));
    const float mirrored = 0.02F + 0.98F * std::pow(1 - sine, 5.0F);
    for (int c = 0; c < 3; ++c) {
      const float seen = light(image, size / 2, size / 2 + below, c);
      const float above = light(image, size / 2, size / 2 - 1 - below, c);
      EXPECT_NEAR(seen / above, mirrored, 0.04F) << below << " " << c;
    }
    ++rows;
  }
  EXPECT_EQ(rows, 8);
}

TEST(LandscapeWater, ShowsItsBedWhereItIsClear) {
  const OffscreenContext context;
  const Camera camera = looking({0, 0, 300}, {0, 0.001F, -1}, 20);
  const auto seen = [&](const std::string& water, float bed) {
    Landscape landscape = lake(water, bed);
    landscape.settings.octaves_normal = landscape.settings.octaves_shadow = 1;  // smooth ground
    const Image image = landscape_picture(LandscapeDrawing(landscape), 32, 32, 0, &camera, 1);
    float sum = 0;
    for (int y = 8; y < 24; ++y)
      for (int x = 8; x < 24; ++x) sum += light(image, x, y, 1);
    return sum / 256;
  };
  const float dry = seen("", 0.5F);
  const float clear = seen("color = [0, 0, 0]\nripples = 0\nclarity = 1000\n", -2);
  const float third = seen("color = [0, 0, 0]\nripples = 0\nclarity = 10\n", -10);
  const float deep = seen("color = [0, 0, 0]\nripples = 0\nclarity = 0.5\n", -30);
  EXPECT_NEAR(clear / dry, 0.98F, 0.03F);
  EXPECT_NEAR((third - deep) / dry, 0.98F * std::exp(-1.0F), 0.03F);
  EXPECT_LT(deep, 0.1F * dry);
}

TEST(LandscapeWater, IsSeenFromAfarAsItsShare) {
  const OffscreenContext context;
  Landscape landscape = lake("color = [0, 0, 0]\nripples = 0\nclarity = 0.5\n");
  landscape.settings.max_rendering_distance = 90000;
  // A pixel of 500 m, 16 samples of the map.
  const Camera camera = looking({0, 0, 40000}, {0, 0.001F, -1}, degrees(2 * std::atan(0.1F)));
  const Image image = landscape_picture(LandscapeDrawing(landscape), 16, 16, 0, &camera, 1);
  const float land = light(image, 8 + 3, 8 + 3, 0);
  const float water = light(image, 8, 8, 0);
  EXPECT_LT(water, 0.6F * land);
}

TEST(LandscapeWater, FastAndFaithfulAgree) {
  const OffscreenContext context;
  Landscape landscape = lake("ripples = 0.03\nclarity = 3\n", -4);
  landscape.settings.cloud_coverage = 0.4F;
  landscape.settings.cloud_steps = 24;
  landscape.settings.cloud_light_steps = 4;
  constexpr int width = 96;
  constexpr int height = 54;
  const Camera camera = looking({0, -600, 25}, {0.2F, 1, -0.08F}, 55);
  const Image plain = landscape_picture(LandscapeDrawing(landscape), width, height, 3, &camera, 4);
  FastLandscapeDrawing fast(landscape, {.ring_size = 256});
  const GpuTarget target(width, height, std::array{PixelFormat::rgba8}, false);
  for (int k = 0; k < 48; ++k) {
    target.bind();
    fast.draw(width, height, 3, camera);
  }
  const Image seen = shown_image(target);
  double sum = 0;
  for (std::size_t k = 0; k < plain.pixels.size(); ++k)
    sum += std::pow(static_cast<double>(plain.pixels[k] - seen.pixels[k]), 2);
  const double psnr = -10 * std::log10(sum / static_cast<double>(plain.pixels.size()));
  RecordProperty("psnr", std::to_string(psnr));
  EXPECT_GE(psnr, 30);
}

}  // namespace
}  // namespace wold
