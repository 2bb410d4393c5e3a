#include "view/traced_view.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/hash.hpp"
#include "render/render.hpp"

namespace wold {

void TracedView::begin(std::shared_ptr<PlantedWorld> world, const SkySettings& sky,
                       const Camera& camera, IVec2 size, int samples) {
  const auto shared = std::make_shared<Shared>();
  shared_ = shared;
  wanted_ = std::max(samples, 1);
  open_ = true;
  error_.clear();
  job_.begin([world = std::move(world), sky, camera, size, samples, shared](Progress& progress) {
    const TracedWorld traced = world->traced(camera, size, progress, &sky);
    const RenderSettings& settings = world->scene().render;
    const CameraRays rays(camera, size.x, size.y);
    Film film(size.x, size.y);
    int done = 0;
    while (done < samples) {
      const int pass = std::clamp(done, 1, 8);
      const SampleRange range{static_cast<std::uint32_t>(done),
                              static_cast<std::uint32_t>(std::min(done + pass, samples))};
      trace_picture(*traced.rays, rays, settings, {range, world->scene().header.seed, false}, film,
                    progress);
      done = static_cast<int>(range.last);
      const std::scoped_lock lock(shared->mutex);
      shared->image = film.image();
      shared->samples = done;
      shared->fresh = true;
    }
    return done;
  });
}

void TracedView::cancel() {
  job_.cancel();
}

void TracedView::close() {
  job_.cancel();
  open_ = false;
  shared_.reset();
}

std::string TracedView::status() {
  if (auto outcome = job_.take())
    if (const auto* error = std::get_if<Error>(&*outcome))
      if (error->kind() != ErrorKind::cancelled) error_ = error->message();
  if (!open_ || !shared_) return {};
  if (!error_.empty()) return error_;
  int samples = 0;
  {
    const std::scoped_lock lock(shared_->mutex);
    samples = shared_->samples;
  }
  if (samples == 0) {
    const std::string stage = job_.report().stage;
    return stage.empty() ? "preparing" : stage;
  }
  if (job_.busy()) return fmt::format("{} of {} samples", samples, wanted_);
  return samples < wanted_ ? fmt::format("stopped after {} samples", samples)
                           : fmt::format("{} samples", samples);
}

double TracedView::done() const {
  if (!shared_) return 0;
  const std::scoped_lock lock(shared_->mutex);
  return static_cast<double>(shared_->samples) / wanted_;
}

std::optional<Image> TracedView::newest() {
  if (!shared_) return std::nullopt;
  const std::scoped_lock lock(shared_->mutex);
  if (!shared_->fresh) return std::nullopt;
  shared_->fresh = false;
  return shared_->image;
}

std::optional<Image> TracedView::picture() const {
  if (!shared_) return std::nullopt;
  const std::scoped_lock lock(shared_->mutex);
  if (shared_->samples == 0) return std::nullopt;
  return shared_->image;
}

TestRays trace_test_rays(PlantedWorld& world, const SkySettings& sky, const Camera& camera,
                         IVec2 size, int count, Progress& progress) {
  const TracedWorld traced = world.traced(camera, size, progress, &sky);
  const CameraRays rays(camera, size.x, size.y);
  const std::uint64_t seed = world.scene().header.seed;
  TestRays out;
  RayCount counts;
  for (int k = 0; k < count; ++k) {
    const std::uint64_t bits = random_bits(seed, hash_text(std::string_view("test rays")), k);
    const Vec2 off(static_cast<float>(bits & 0xffffU) / 65536 - 0.5F,
                   static_cast<float>((bits >> 16U) & 0xffffU) / 65536 - 0.5F);
    const Vec2 pixel = Vec2(size) * (Vec2(0.5F) + 0.1F * off);
    std::vector<PathVertex> path;
    PathSettings settings{world.scene().render.max_bounces, &path};
    Sampler sampler(seed, k, 0, 0);
    trace_path(*traced.rays, settings, rays.ray(pixel, Vec2(0.5F)), rays.pixel_angle(), sampler,
               counts);
    out.paths.push_back(std::move(path));
  }
  return out;
}

}  // namespace wold
