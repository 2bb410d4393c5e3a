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

namespace {

/// The view has these of its own.
constexpr std::array<std::string_view, 11> view_knobs{
    "SUN_ELEVATION", "SUN_AZIMUTH", "DAY_SPEED",     "EXPOSURE", "CAM_HEIGHT",   "CAM_SPEED",
    "CAM_EAST",      "CAM_NORTH",   "CAM_DIRECTION", "CAM_TILT", "FIELD_OF_VIEW"};

}  // namespace

ParameterSet ShaderView::free_knobs() {
  ParameterSet set = describe(LandscapeSettings());
  std::erase_if(set.parameters, [](const Parameter& p) {
    return std::find(view_knobs.begin(), view_knobs.end(), p.name) != view_knobs.end();
  });
  return set;
}

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
    const Ground& ground = world->world().ground;
    options.finished.emplace(FinishedLand{ground.field(), world->maps(), ground.dressing()});
    Landscape landscape = landscape_of(scene, options, progress);
    set_knobs(landscape.settings, defines);
    return landscape;
  });
}

void ShaderView::take() {
  std::optional<BackgroundJob<Landscape>::Outcome> outcome = job_.take();
  if (!outcome) return;
  if (const auto* error = std::get_if<Error>(&*outcome)) throw *error;
  const LandscapeSettings before = std::exchange(landscape_.settings, {});
  landscape_ = std::get<Landscape>(std::move(*outcome));
  // What was changed by hand stays so.
  const LandscapeSettings edited = std::exchange(knobs_, landscape_.settings);
  for (const Parameter& p : generation_ > 0 ? free_knobs().parameters : std::vector<Parameter>())
    if (p.get(&edited) != p.get(&before)) p.set(&knobs_, p.get(&edited));
  ++generation_;
  compile();
}

void ShaderView::compile() {
  Landscape landscape = landscape_;
  landscape.settings = knobs_;
  next_ = Next{FastLandscapeDrawing(landscape, settings_), knobs_,
               domain_of(world_->scene().terrain).center()};
}

void ShaderView::compile_next() {
  if (!next_) return;
  try {
    next_->left = next_->drawing.compile_next(true);
  } catch (const Error&) {
    // Knobs with which the driver fails are not kept.
    if (drawing_) knobs_ = shown_knobs_;
    throw;
  }
  next_->programs = std::max(next_->programs, next_->left + 1);
  if (next_->left > 0) return;
  drawing_ = std::move(next_->drawing);
  shown_knobs_ = next_->knobs;
  exposure_ = shown_knobs_.exposure;
  middle_ = next_->middle;
  next_.reset();
}

void ShaderView::knobs_changed() {
  if (world_ && generation_ > 0 && !job_.busy()) compile();
}

ProgressReport ShaderView::report() const {
  if (!next_) return job_.report();
  ProgressReport report;
  report.stage = "compiling";
  report.unit = "programs";
  report.total = next_->programs;
  report.done = next_->programs - next_->left;
  return report;
}

void ShaderView::cancel() {
  job_.cancel();
  next_.reset();
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
  compile_next();
  if (drawing_)
    drawing_->set_sun(degrees(std::asin(std::clamp(sun.z, -1.0F, 1.0F))),
                      degrees(std::atan2(sun.x, sun.y)));
}

void ShaderView::make(const std::shared_ptr<PlantedWorld>& world, const SkySettings& sky, Vec3 sun,
                      Progress& progress) {
  want(world, sky, sun);
  while (busy()) {
    if (progress.cancelled()) cancel();
    progress.check();
    if (!next_) std::this_thread::sleep_for(std::chrono::milliseconds(2));
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
  stops_ = exposure_ + stops;
  drawing_->set_exposure(stops_);
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
