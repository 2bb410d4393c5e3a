#include "view/shader_view.hpp"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <thread>
#include <utility>
#include <variant>

#include "realtime/landscape_picture.hpp"
#include "scene/same_scene.hpp"

namespace wold {

ShaderView::ShaderView(std::vector<std::string> defines, const FastLandscapeSettings& settings)
    : defines_(std::move(defines)), settings_(settings) {
  LandscapeSettings checked;
  set_knobs(checked, defines_);
}

void ShaderView::begin(const std::shared_ptr<PlantedWorld>& world, const SkySettings& sky) {
  if (world == world_ && sky_ && same_but_sun(*sky_, sky)) return;
  world_ = world;
  sky_ = sky;
  job_.begin([world, sky, defines = defines_](Progress& progress) {
    Scene scene = world->scene();
    scene.sky = sky;
    LandscapeOptions options;
    options.source = is_function(scene) ? LandSource::function : LandSource::map;
    options.finished = &world->world().ground.field();
    Landscape landscape = landscape_of(scene, options, progress);
    set_knobs(landscape.settings, defines);
    return landscape;
  });
}

void ShaderView::take() {
  std::optional<BackgroundJob<Landscape>::Outcome> outcome = job_.take();
  if (!outcome) return;
  if (const auto* error = std::get_if<Error>(&*outcome)) throw *error;
  const Landscape landscape = std::get<Landscape>(std::move(*outcome));
  drawing_.emplace(landscape, settings_);
  exposure_ = landscape.settings.exposure;
  middle_ = domain_of(world_->scene().terrain).center();
}

void ShaderView::cancel() {
  job_.cancel();
  world_.reset();
  sky_.reset();
}

void ShaderView::forget() {
  cancel();
  drawing_.reset();
}

void ShaderView::want(const std::shared_ptr<PlantedWorld>& world, const SkySettings& sky,
                      Vec3 sun) {
  begin(world, sky);
  take();
  if (drawing_)
    drawing_->set_sun(degrees(std::asin(std::clamp(sun.z, -1.0F, 1.0F))),
                      degrees(std::atan2(sun.x, sun.y)));
}

void ShaderView::make(const std::shared_ptr<PlantedWorld>& world, const SkySettings& sky,
                      Vec3 sun) {
  want(world, sky, sun);
  while (busy()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    want(world, sky, sun);
  }
}

void ShaderView::cut() {
  if (drawing_) drawing_->cut();
}

void ShaderView::draw(const Camera& camera, IVec2 size, float seconds, float stops) {
  if (!drawing_) return;
  if (!target_ || target_.width() != size.x || target_.height() != size.y)
    target_ = GpuTarget(size.x, size.y, std::array{PixelFormat::rgba8}, false);
  Camera eye = camera;
  eye.position -= Vec3(Vec2(middle_), 0);
  drawing_->set_exposure(exposure_ + stops);
  target_.bind();
  drawing_->draw(size.x, size.y, seconds, eye);
}

void ShaderView::show(int width, int height) const {
  if (!target_) return;
  glBindFramebuffer(GL_READ_FRAMEBUFFER, target_.id());
  glBlitFramebuffer(0, 0, target_.width(), target_.height(), 0, 0, width, height,
                    GL_COLOR_BUFFER_BIT, GL_LINEAR);
}

Image ShaderView::picture() const {
  return target_ ? shown_image(target_) : Image();
}

}  // namespace wold
