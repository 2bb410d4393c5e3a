#include "raster/picture_drawing.hpp"

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include "gpu/context.hpp"
#include "image/color.hpp"
#include "image/tonemap.hpp"
#include "render/film.hpp"

namespace wold {
namespace {

constexpr int width = 48;
constexpr int height = 32;

Camera some_camera() {
  Camera camera;
  camera.position = {100, -50, 400};
  camera.direction = glm::normalize(Vec3(0.3F, 1, 0.1F));
  camera.field_of_view = 80;
  return camera;
}

SkySettings settings_of(SkyModel model) {
  SkySettings settings;
  settings.model = model;
  settings.sun = {35, 120};
  settings.eye_height = 400;
  return settings;
}

Vec3 pixel(const Image& image, int x, int y) {
  return white_luminance * Vec3(image.at(x, y, 0), image.at(x, y, 1), image.at(x, y, 2));
}

class PictureOf : public testing::TestWithParam<SkyModel> {
 protected:
  OffscreenContext context_;
};

/// The largest difference between a picture and what each of its rays sees, relative.
template <class Seen>
float largest_error(const Image& image, const Seen& seen) {
  const CameraRays rays(some_camera(), width, height);
  float largest = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const Ray ray =
          rays.ray({static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F}, Vec2(0.5F));
      const Vec3 expected = seen(ray);
      largest =
          std::max(largest, glm::length(pixel(image, x, y) - expected) / glm::length(expected));
    }
  return largest;
}

TEST_P(PictureOf, NothingButTheSkyIsTheSkyTheRightWayUp) {
  const Sky sky(settings_of(GetParam()));
  SceneLight light(sky, {.size = 0});
  PictureDrawing picture(light);
  picture.resize(width, height);
  for (int k = 0; k < 16; ++k)
    picture.draw(some_camera(), [](const DrawView&, const SceneLight*) {});
  const Image image = picture.linear_image();
  EXPECT_EQ(picture.frames(), 16);
  EXPECT_EQ(image.at(5, 5, 3), 0);
  // Half floats, and the mean over a pixel of 1.7 degrees instead of its middle.
  EXPECT_LT(largest_error(image, [&](const Ray& ray) { return sky.radiance(ray.direction); }),
            0.03F);
}

TEST_P(PictureOf, ASurfaceIsSeenThroughTheAir) {
  const Sky sky(settings_of(GetParam()));
  SceneLight light(sky, {.size = 0});
  PictureDrawing picture(light);
  picture.resize(width, height);
  constexpr float depth = 20000;
  const Camera camera = some_camera();
  for (int k = 0; k < 16; ++k)
    picture.draw(camera, [&](const DrawView& view, const SceneLight*) {
      const Vec2 range = stored_depth_range();
      glClearColor(1000, 500, 200, 1);
      glClearDepthf((view.nearest / depth - range.x) / range.y);
      glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
      glClearDepthf(0);
    });
  const Image image = picture.linear_image();
  EXPECT_EQ(image.at(5, 5, 3), 1);
  const Ray middle = CameraRays(camera, width, height).ray(Vec2(5.5F), Vec2(0.5F));
  const float away = depth / glm::dot(middle.direction, camera.direction);
  EXPECT_NEAR(picture.distances().at(5, 5, 0), away, 1e-3F * away);
  EXPECT_LT(largest_error(
                image,
                [&](const Ray& ray) {
                  const float distance = depth / glm::dot(ray.direction, camera.direction);
                  return sky.through_haze({1000, 500, 200}, ray.origin, ray.direction, distance);
                }),
            0.02F);
}

INSTANTIATE_TEST_SUITE_P(Skies, PictureOf,
                         testing::Values(SkyModel::preetham, SkyModel::atmosphere));

class Display : public testing::Test {
 protected:
  OffscreenContext context_;
};

TEST_F(Display, ToneMapsAreTheirTwins) {
  const Sky sky;
  SceneLight light(sky, {.size = 0});
  PictureDrawing picture(light);
  picture.resize(width, height);
  const GpuTarget screen(width, height, std::array{PixelFormat::rgba32f}, false);
  for (const ToneOperator op : {ToneOperator::clip, ToneOperator::exponential, ToneOperator::agx,
                                ToneOperator::agx_punchy, ToneOperator::neutral}) {
    for (const Vec3 color : {Vec3(0), Vec3(0.02F, 0.05F, 0.01F), Vec3(0.18F),
                             Vec3(0.9F, 0.5F, 0.2F), Vec3(3, 8, 20), Vec3(4000)}) {
      SkySettings none;
      none.haze = false;
      SceneLight dark(Sky(none), {.size = 0});
      PictureDrawing one(dark);
      one.resize(width, height);
      one.draw(some_camera(), [&](const DrawView&, const SceneLight*) {
        glClearColor(color.x, color.y, color.z, 1);
        glClearDepthf(1);
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        glClearDepthf(0);
      });
      screen.bind();
      one.show(width, height, {.tone_map = op}, std::log2(white_luminance));
      const std::vector<float> shown = screen.read();
      const Vec3 expected = tone_mapped(color, op);
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(shown[static_cast<std::size_t>(4 * (width * 7 + 9) + c)],
                    linear_to_srgb(expected[c]), 0.75F / 255)
            << static_cast<int>(op) << ' ' << color.x;
    }
  }
}

TEST_F(Display, TheSkyIsAtNoDistance) {
  SceneLight light(Sky{}, {.size = 0});
  PictureDrawing picture(light);
  picture.resize(width, height);
  EXPECT_EQ(picture.distances().at(1, 1, 0), 0) << "before any frame";
  picture.draw(some_camera(), [](const DrawView&, const SceneLight*) {});
  EXPECT_EQ(picture.distances().at(1, 1, 0), 0);
}

TEST_F(Display, AWindowOfNoSizeIsOnePixel) {
  SceneLight light(Sky{}, {.size = 0});
  PictureDrawing picture(light);
  picture.resize(0, 0);
  picture.draw(some_camera(), [](const DrawView&, const SceneLight*) {});
  EXPECT_EQ(picture.linear_image().width, 1);
}

TEST_F(Display, ExposureIsMeteredAsThatOfARender) {
  SceneLight light(Sky{}, {.size = 0});
  PictureDrawing picture(light);
  picture.resize(width, height);
  for (int k = 0; k < 4; ++k)
    picture.draw(some_camera(), [](const DrawView&, const SceneLight*) {});
  const Image image = picture.linear_image();
  EXPECT_NEAR(picture.metered_exposure(), measured_exposure(image, land_weights(image)), 0.05F);
}

}  // namespace
}  // namespace wold
