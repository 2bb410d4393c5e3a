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
  Grid<float> lit;       ///< of the rays to the ground, those whose place sees the sun
};

inline constexpr int likeness_rays = 16;  // of a pixel

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
    const Vec2 within = (Vec2(k % 4, k / 4) + 0.5F) / 4.0F;
    const Ray ray = rays.ray(Vec2(x, y) + within, Vec2(0.5F));
    const Hit hit = scene.intersect(ray, 0, true, count);
    if (!hit.valid()) {
      ++out.sky;
      continue;
    }
    out.distance += glm::distance(hit.position, ray.origin) / likeness_rays;
    if (hit.instance != Hit::ground) {
      ++out.plant;
      continue;
    }
    ++out.ground;
    out.lit += scene.occluded({hit.position + 0.02F * hit.normal, sun}, 0, 1e9F, count) ? 0 : 1;
  }
  return out;
}

/// What frames of a drawing show in a pixel, each at another place within it.
struct ShownByFrames {
  int sky = 0;
  int ground = 0;
  int frames = 0;
};

/// Adds the last frame. What lies on the ground, but for a few centimetres or most of a pixel, is
/// ground.
inline void add_frame(Grid<ShownByFrames>& shown, const PictureDrawing& picture,
                      const CameraRays& rays, float pixel_angle, const Ground& ground) {
  const Image distances = picture.distances();
  parallel_for(0, shown.height(), [&](int y) {
    for (int x = 0; x < shown.width(); ++x) {
      ShownByFrames& pixel = shown(x, y);
      ++pixel.frames;
      const float distance = distances.at(x, y, 0);
      if (distance <= 0) {
        ++pixel.sky;
        continue;
      }
      const Ray ray = rays.ray(Vec2(x, y) + 0.5F, Vec2(0.5F));
      const Vec3 place = ray.origin + distance * ray.direction;
      const float pixel_size = pixel_angle * distance;
      const GroundSample land = ground.detailed(DVec2(place.x, place.y), pixel_size);
      const float above = (place.z - land.height) * normal_of(land.gradient).z;
      if (above < 0.03F + 0.7F * pixel_size) ++pixel.ground;
    }
  });
}

/// What both show alone. Ground is sunlit or in the shade where nearly all, or hardly any, of the
/// rays within two pixels see the sun.
inline Grid<Shown> shown_kinds(const Grid<ShownByRays>& traced, const Grid<ShownByFrames>& drawn) {
  Grid<Shown> out(traced.width(), traced.height(), Shown::mixed);
  for (int y = 0; y < traced.height(); ++y)
    for (int x = 0; x < traced.width(); ++x) {
      const ShownByRays& rays = traced(x, y);
      const ShownByFrames& frames = drawn(x, y);
      if (rays.sky == likeness_rays && frames.sky == frames.frames) out(x, y) = Shown::sky;
      if (rays.plant == likeness_rays && frames.sky + frames.ground == 0) out(x, y) = Shown::plant;
      if (rays.ground < likeness_rays || frames.ground < frames.frames) continue;
      int ground = 0;
      int lit = 0;
      for (int j = -2; j <= 2; ++j)
        for (int i = -2; i <= 2; ++i) {
          const ShownByRays& near = traced.clamped(x + i, y + j);
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
  out.lit = Grid<float>(size.x, size.y);
  parallel_for(0, size.y, [&](int y) {
    for (int x = 0; x < size.x; ++x) {
      const ShownByRays shown = shown_by_rays(*traced.rays, rays, x, y);
      by_rays(x, y) = shown;
      out.distance(x, y) = shown.distance;
      out.lit(x, y) = static_cast<float>(shown.lit) / static_cast<float>(std::max(shown.ground, 1));
    }
  });
  SceneDrawing drawing(world, scene_detail(quality), progress);
  drawing.resize(size.x, size.y);
  drawing.settle(camera);
  Grid<ShownByFrames> by_frames(size.x, size.y);
  const float pixel_angle = camera_view(camera, size.x, size.y).pixel_angle;
  for (int k = 0; k < frames; ++k) {
    drawing.draw(camera);
    add_frame(by_frames, drawing.picture(), rays, pixel_angle, world.world().ground);
  }
  out.shown = shown_kinds(by_rays, by_frames);
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
