#include "raster/picture_drawing.hpp"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "render/film.hpp"

namespace wold {

namespace {

constexpr int metering_size = 128;  // pixels on the longer side

float radical_inverse(int base, int index) {
  float value = 0;
  float share = 1;
  for (; index > 0; index /= base) {
    share /= static_cast<float>(base);
    value += share * static_cast<float>(index % base);
  }
  return value;
}

/// Where within its pixel a frame looks, from -0.5 to 0.5.
Vec2 jitter_of(int frame) {
  const int k = 1 + frame % 1024;
  return {radical_inverse(2, k) - 0.5F, radical_inverse(3, k) - 0.5F};
}

bool same(const Camera& a, const Camera& b) {
  return a.position == b.position && a.direction == b.direction && a.up == b.up &&
         a.field_of_view == b.field_of_view;
}

void in_white_luminances(Image& image) {
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < 3; ++c) image.at(x, y, c) /= white_luminance;
}

}  // namespace

Description<PictureQuality> describe(const PictureQuality&) {
  using Q = PictureQuality;
  return Description<Q>("picture", "How fine pictures are drawn.")
      .add("cloud_steps", &Q::cloud_steps, {.min = 1, .max = 1024},
           "Steps of a ray through the clouds.")
      .add("cloud_light_steps", &Q::cloud_light_steps, {.min = 1, .max = 256},
           "Steps from there towards the sun.")
      .add("cloud_scale", &Q::cloud_scale, {.min = 0.1, .max = 1},
           "Size of the clouds' picture against the whole.");
}

PictureDrawing::PictureDrawing(SceneLight& light, const PictureQuality& quality)
    : light_(light),
      sky_(light.sky()),
      quality_(quality),
      resolve_(full_screen_program("raster/resolve.frag.glsl")),
      display_(full_screen_program("raster/display.frag.glsl")),
      copy_(full_screen_program("raster/copy.frag.glsl")) {
  use_reversed_depth();
}

void PictureDrawing::resize(int width, int height) {
  width = std::max(width, 1);
  height = std::max(height, 1);
  if (width == width_ && height == height_) return;
  surfaces_ = GpuTarget(width, height, std::array{PixelFormat::rgba16f}, true);
  frame_ = GpuTarget(width, height, std::array{PixelFormat::rgba16f}, false);
  for (GpuTarget& mean : means_)
    mean = GpuTarget(width, height, std::array{PixelFormat::rgba32f}, false);
  width_ = width;
  height_ = height;
  frames_ = 0;
  fresh_ = true;
}

void PictureDrawing::sky_changed() {
  sky_.set_sky(light_.sky());
  light_.shadows().forget();
  restart();
}

void PictureDrawing::draw(const Camera& camera, const DrawSurfaces& surfaces) {
  if (last_camera_ && !same(*last_camera_, camera)) frames_ = 0;
  const bool moving = frames_ == 0 && !fresh_ && last_camera_.has_value();
  light_.set_frame(number_);
  const DrawView view =
      camera_view(camera, width_, height_, 0.1F, jitter_of(moving ? number_ : frames_));
  light_.shadows().update(view, light_.sky().sun_direction(), [&](const DrawView& shadow) {
    glDisable(GL_CULL_FACE);
    surfaces(shadow, nullptr);
  });
  surfaces_.bind();
  glEnable(GL_DEPTH_TEST);
  glDepthMask(GL_TRUE);
  glDisable(GL_BLEND);
  glClearColor(0, 0, 0, 0);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  surfaces(view, &light_);
  sky_.draw({.view = &view,
             .surfaces = &surfaces_.color(),
             .depth = &surfaces_.depth(),
             .number = number_,
             .clouds = {quality_.cloud_steps, quality_.cloud_light_steps},
             .cloud_scale = quality_.cloud_scale},
            frame_);
  const int next = 1 - newest_;
  means_[static_cast<std::size_t>(next)].bind();
  apply_picture(resolve_, view, surfaces_.depth(), 0);
  resolve_.set("frame", 1);
  frame_.color().bind(1);
  resolve_.set("history", 2);
  mean().color().bind(2);
  resolve_.set("last_view_projection", last_view_projection_);
  resolve_.set("still", !moving);
  resolve_.set("share", moving ? 0.1F : 1 / static_cast<float>(frames_ + 1));
  draw_full_screen();
  newest_ = next;
  last_camera_ = camera;
  last_view_projection_ = camera_view(camera, width_, height_).view_projection;
  fresh_ = false;
  ++frames_;
  ++number_;
}

Image PictureDrawing::linear_image() const {
  const std::vector<float> pixels = mean().read();
  Image image(width_, height_, {"R", "G", "B", "A"});
  const auto row = 4 * static_cast<std::size_t>(width_);
  for (int y = 0; y < height_; ++y)
    std::copy_n(pixels.begin() +
                    static_cast<std::ptrdiff_t>(row * static_cast<std::size_t>(height_ - 1 - y)),
                row, image.row(y).begin());
  in_white_luminances(image);
  return image;
}

Image PictureDrawing::distances() const {
  Image image(width_, height_, {"Z"});
  if (!last_camera_) return image;
  const DrawView view = camera_view(*last_camera_, width_, height_);
  std::vector<float> stored(image.pixels.size());
  glBindFramebuffer(GL_READ_FRAMEBUFFER, surfaces_.id());
  glReadPixels(0, 0, width_, height_, GL_DEPTH_COMPONENT, GL_FLOAT, stored.data());
  const Vec2 range = stored_depth_range();
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x) {
      const int row = height_ - 1 - y;
      const float depth =
          range.x +
          range.y * stored[static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) +
                           static_cast<std::size_t>(x)];
      const Vec2 at = 2.0F * (Vec2(x, row) + 0.5F) / Vec2(width_, height_) - 1.0F;
      const Vec3 ray = view.forward + at.x * view.right + at.y * view.above;
      image.at(x, y, 0) = depth > 0 ? view.nearest / depth * glm::length(ray) : 0.0F;
    }
  return image;
}

void PictureDrawing::show(int width, int height, const ToneMapping& mapping, float stops) const {
  glViewport(0, 0, width, height);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_BLEND);
  display_.set("picture", 0);
  mean().color().bind(0);
  display_.set("exposure", std::exp2(stops) / white_luminance);
  display_.set("tone_map", static_cast<int>(mapping.tone_map));
  draw_full_screen();
}

float PictureDrawing::metered_exposure() const {
  const float scale = std::min(
      1.0F, static_cast<float>(metering_size) / static_cast<float>(std::max(width_, height_)));
  const auto part = [scale](int size) {
    return std::max(1, static_cast<int>(std::lround(static_cast<float>(size) * scale)));
  };
  const GpuTarget small(part(width_), part(height_), std::array{PixelFormat::rgba32f}, false);
  small.bind();
  glDisable(GL_DEPTH_TEST);
  copy_.set("picture", 0);
  mean().color().bind(0);
  draw_full_screen();
  const std::vector<float> pixels = small.read();
  Image image(small.width(), small.height(), {"R", "G", "B", "A"});
  // Upside down: metering by cover does not mind.
  image.pixels = pixels;
  in_white_luminances(image);
  return measured_exposure(image, land_weights(image));
}

}  // namespace wold
