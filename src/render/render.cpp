#include "render/render.hpp"

#include <tbb/enumerable_thread_specific.h>
#include <x86intrin.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "base/parallel.hpp"

namespace wold {

namespace {

constexpr int tile_size = 16;
constexpr std::uint32_t samples_per_pass = 8;

/// Offset with the density of a tent filter, in units of half its width.
float tent(float u) {
  return u < 0.5F ? std::sqrt(2 * u) - 1 : 1 - std::sqrt(2 - 2 * u);
}

struct ThreadCounts {
  RayCount rays;
  std::uint64_t paths = 0;
  std::uint64_t ticks = 0;
};

class Picture {
 public:
  Picture(const RayScene& scene, const CameraRays& camera, const RenderSettings& settings,
          const RenderJob& job, Film& film)
      : scene_(scene),
        camera_(camera),
        settings_(settings),
        paths_{settings.max_bounces},
        job_(job),
        film_(film) {}

  void trace_row(int y, int x_begin, int x_end, SampleRange range, ThreadCounts& counts) const {
    counts.rays.timed = job_.timed;
    for (int x = x_begin; x < x_end; ++x)
      for (std::uint32_t index = range.first; index < range.last; ++index)
        film_.add(x, y, trace(x, y, index, counts));
  }

 private:
  PathSample trace(int x, int y, std::uint32_t index, ThreadCounts& counts) const {
    Sampler sampler(job_.seed, x, y, index);
    const Vec2 u = sampler.next();
    const Vec2 lens = sampler.next();
    const Vec2 offset = settings_.filter_width * 0.5F * Vec2(tent(u.x), tent(u.y));
    const Vec2 pixel = Vec2(static_cast<float>(x), static_cast<float>(y)) + Vec2(0.5F) + offset;
    ++counts.paths;
    return trace_path(scene_, paths_, camera_.ray(pixel, lens), camera_.pixel_angle(), sampler,
                      counts.rays);
  }

  const RayScene& scene_;
  const CameraRays& camera_;
  const RenderSettings& settings_;
  PathSettings paths_;
  const RenderJob& job_;
  Film& film_;
};

}  // namespace

Description<RenderSettings> describe(const RenderSettings&) {
  using R = RenderSettings;
  return Description<R>("render", "How the picture is traced.")
      .add("size", &R::size, {.unit = "pixels", .min = 1, .max = 65536},
           "Width and height of the picture.")
      .add("samples", &R::samples, {.min = 1, .max = 1048576}, "Light paths for each pixel.")
      .add("max_bounces", &R::max_bounces, {.min = 0, .max = 64},
           "Surfaces that a light path may meet after the first.")
      .add("dicing", &R::dicing, {.unit = "pixels", .min = 0.25, .max = 100},
           "Distance between samples of the ground, as seen.")
      .add("filter_width", &R::filter_width, {.unit = "pixels", .min = 0, .max = 8},
           "Width of the tent filter over each pixel.");
}

RenderCounts trace_picture(const RayScene& scene, const CameraRays& camera,
                           const RenderSettings& settings, const RenderJob& job, Film& film,
                           Progress& progress) {
  const int columns = (film.width() + tile_size - 1) / tile_size;
  const int rows = (film.height() + tile_size - 1) / tile_size;
  const Picture picture(scene, camera, settings, job, film);
  tbb::enumerable_thread_specific<ThreadCounts> counts;
  RenderCounts total;
  const auto began = std::chrono::steady_clock::now();
  const double pixels = static_cast<double>(film.width()) * film.height();
  progress.begin("rendering", pixels * (job.range.last - job.range.first), "paths");
  for (std::uint32_t first = job.range.first; first < job.range.last;) {
    // The first pass is of one sample, to have a whole picture soon.
    const std::uint32_t count = first == job.range.first ? 1 : samples_per_pass;
    const SampleRange pass{first, std::min(job.range.last, first + count)};
    parallel_for(0, columns * rows, [&](int tile) {
      ThreadCounts& own = counts.local();
      const std::uint64_t before = job.timed ? __rdtsc() : 0;
      const int x = tile % columns * tile_size;
      const int y = tile / columns * tile_size;
      const int x_end = std::min(x + tile_size, film.width());
      for (int row = y; row < std::min(y + tile_size, film.height()); ++row) {
        picture.trace_row(row, x, x_end, pass, own);
        progress.advance(static_cast<double>(x_end - x) * (pass.last - pass.first));
      }
      if (job.timed) own.ticks += __rdtsc() - before;
    });
    if (first == job.range.first)
      total.first_pass_seconds =
          std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    first = pass.last;
  }
  progress.end();
  for (const ThreadCounts& own : counts) {
    total.paths += own.paths;
    total.rays += own.rays.rays;
    total.embree_ticks += own.rays.ticks;
    total.all_ticks += own.ticks;
  }
  return total;
}

}  // namespace wold
