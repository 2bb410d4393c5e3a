#pragma once
// A scene drawn beside the same scene traced: what each pixel shows, and the mean colours of both
// where they show the same kind of thing.
//
// Whether ground lies in the shade is told by the rays around as well: to choose the pixels whose
// own rays all miss the sun would be to choose those where gaps between leaves happen to be closed,
// and darker than the shade is.

#include <algorithm>
#include <array>

#include "base/parallel.hpp"
#include "raster/scene_drawing.hpp"
#include "render/render.hpp"

namespace wold {

enum class Shown { sky, sunlit, shade, plant, mixed };

struct Likeness {
  Image traced;
  Image drawn;
  Grid<Shown> shown;
  Grid<float> distance;  ///< m; 0 of sky
};

inline constexpr int likeness_rays = 5;  // of a pixel

struct ShownByRays {
  int sky = 0;
  int plant = 0;
  int ground = 0;
  int lit = 0;  // of those on the ground
  float distance = 0;
};

inline ShownByRays shown_by_rays(const RayScene& scene, const CameraRays& rays, int x, int y) {
  ShownByRays out;
  RayCount count;
  const Vec3 sun = scene.world().sky.sun_direction();
  for (int k = 0; k < likeness_rays; ++k) {
    const Vec2 off =
        k == 0 ? Vec2(0.5F) : Vec2((k & 1) != 0 ? 0.1F : 0.9F, (k & 2) != 0 ? 0.1F : 0.9F);
    const Ray ray = rays.ray(Vec2(static_cast<float>(x), static_cast<float>(y)) + off, Vec2(0.5F));
    const Hit hit = scene.intersect(ray, 0, true, count);
    if (!hit.valid()) {
      ++out.sky;
      continue;
    }
    if (k == 0) out.distance = glm::distance(hit.position, ray.origin);
    if (hit.instance != Hit::ground) {
      ++out.plant;
      continue;
    }
    ++out.ground;
    out.lit += scene.occluded({hit.position + 0.02F * hit.normal, sun}, 0, 1e9F, count) ? 0 : 1;
  }
  return out;
}

/// Ground is sunlit or in the shade where nearly all, or hardly any, of the rays within two pixels
/// see the sun.
inline Grid<Shown> shown_kinds(const Grid<ShownByRays>& rays) {
  Grid<Shown> out(rays.width(), rays.height(), Shown::mixed);
  for (int y = 0; y < rays.height(); ++y)
    for (int x = 0; x < rays.width(); ++x) {
      const ShownByRays& own = rays(x, y);
      if (own.sky == likeness_rays) out(x, y) = Shown::sky;
      if (own.plant == likeness_rays) out(x, y) = Shown::plant;
      if (own.ground < likeness_rays) continue;
      int ground = 0;
      int lit = 0;
      for (int j = -2; j <= 2; ++j)
        for (int i = -2; i <= 2; ++i) {
          const ShownByRays& near = rays.clamped(x + i, y + j);
          ground += near.ground;
          lit += near.lit;
        }
      const double share = static_cast<double>(lit) / ground;
      if (share > 0.97) out(x, y) = Shown::sunlit;
      if (share < 0.2) out(x, y) = Shown::shade;
    }
  return out;
}

/// Needs a current context.
inline Likeness likeness(PlantedWorld& world, const Camera& camera, IVec2 size, unsigned samples,
                         DrawingQuality quality, int frames) {
  Progress progress;
  Likeness out;
  const TracedWorld traced = world.traced(camera, size, progress);
  const CameraRays rays(camera, size.x, size.y);
  RenderSettings settings = world.scene().render;
  settings.size = size;
  Film film(size.x, size.y);
  trace_picture(*traced.rays, rays, settings, {{0, samples}, 1, false}, film, progress);
  out.traced = film.image();
  Grid<ShownByRays> by_rays(size.x, size.y);
  out.distance = Grid<float>(size.x, size.y);
  parallel_for(0, size.y, [&](int y) {
    for (int x = 0; x < size.x; ++x) {
      by_rays(x, y) = shown_by_rays(*traced.rays, rays, x, y);
      out.distance(x, y) = by_rays(x, y).distance;
    }
  });
  out.shown = shown_kinds(by_rays);
  SceneDrawing drawing(world, scene_detail(quality), progress);
  drawing.resize(size.x, size.y);
  drawing.settle(camera);
  for (int k = 0; k < frames; ++k) drawing.draw(camera);
  out.drawn = drawing.picture().linear_image();
  return out;
}

struct MeanColors {
  Vec3 traced{0};
  Vec3 drawn{0};
  int pixels = 0;
};

/// Over what is of this kind, between these distances (m).
inline MeanColors mean_colors(const Likeness& l, Shown kind, float from = 0, float to = 1e9F) {
  const auto channels = [](const Image& image) {
    return std::array{image.find("R"), image.find("G"), image.find("B")};
  };
  const std::array<int, 3> traced = channels(l.traced);
  const std::array<int, 3> drawn = channels(l.drawn);
  DVec3 traced_sum(0);
  DVec3 drawn_sum(0);
  MeanColors out;
  for (int y = 0; y < l.shown.height(); ++y)
    for (int x = 0; x < l.shown.width(); ++x) {
      if (l.shown(x, y) != kind || l.distance(x, y) < from || l.distance(x, y) >= to) continue;
      ++out.pixels;
      for (int c = 0; c < 3; ++c) {
        const auto k = static_cast<std::size_t>(c);
        traced_sum[c] += static_cast<double>(l.traced.at(x, y, traced[k]));
        drawn_sum[c] += static_cast<double>(l.drawn.at(x, y, drawn[k]));
      }
    }
  const double count = std::max(out.pixels, 1);
  out.traced = Vec3(traced_sum / count);
  out.drawn = Vec3(drawn_sum / count);
  return out;
}

}  // namespace wold
