#pragma once
// Radiance along a camera path, by path tracing.
//
//   L_o = ∫ f L_i |cos| dω, paths built from the camera; at every surface the sun's disc and the
//   sky are sampled directly, and the sky also by the surface, both weighted by the power heuristic
//   (Veach 1997, with exponent 2). The sun is found by direct sampling alone after the first
//   surface. Russian roulette by throughput from the second bounce on. Air between surfaces by
//   Sky::air_light.

#include <vector>

#include "render/film.hpp"
#include "render/ray_scene.hpp"
#include "render/sampler.hpp"

namespace wold {

/// A place that a path came to, for those who want to see paths.
struct PathVertex {
  Vec3 position{0};     ///< m
  bool surface = true;  ///< else where the path left into the sky, drawn a way out
  bool sees_sun = false;
};

struct PathSettings {
  int max_bounces = 6;                          ///< surfaces that a path may meet after the first
  std::vector<PathVertex>* vertices = nullptr;  ///< takes the path's, from the eye on, if given
};

/// What is seen at a hit, ready to scatter light.
struct SurfacePoint {
  Vec3 position{0};
  Vec3 geometric_normal{0, 0, 1};  ///< on the viewer's side
  Vec3 normal{0, 0, 1};            ///< for shading, on the viewer's side
  Vec3 reflectance{0};
  Vec3 transmittance{0};
  float roughness = 0;
};

/// `footprint`: width of the pixel or path there, m.
SurfacePoint surface_at(const World& world, const Hit& hit, Vec3 view_direction, float footprint);

/// Traces one path. `pixel_angle` in radians sets how much texture detail is resolved.
PathSample trace_path(const RayScene& scene, const PathSettings& settings, const Ray& camera_ray,
                      float pixel_angle, Sampler& sampler, RayCount& count);

}  // namespace wold
