#pragma once
// Small worlds whose light is known in closed form.

#include <memory>

#include "render/ray_scene.hpp"
#include "render/render.hpp"

namespace wold::testing {

/// Ground of one colour everywhere: snow from far below, no detail.
inline GroundMaterial plain(Vec3 reflectance) {
  GroundMaterial m;
  m.snow_color = reflectance;
  m.snow_height = {-20000, -19000};
  m.snow_slope = {89, 90};
  m.detail = 0;
  m.distant_forest = 0;
  return m;
}

inline Heightfield flat(double size, float height = 0) {
  Heightfield field;
  field.height = Grid<float>(17, 17, height);
  field.cell = size / 16;
  field.origin = DVec2(-size / 2);
  return field;
}

/// A square of two triangles, facing up at z = 0, or upright in the plane y = 0 facing south.
inline TriangleMesh square(float size, bool upright = false) {
  TriangleMesh mesh;
  const float h = size / 2;
  for (const Vec2 c : {Vec2(-h, -h), Vec2(h, -h), Vec2(h, h), Vec2(-h, h)})
    mesh.positions.push_back(upright ? Vec3(c.x, 0, c.y) : Vec3(c, 0));
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.parts = {{"sheet", 0, 2}};
  return mesh;
}

inline Material sheet(Vec3 reflectance, Vec3 transmission) {
  Material m;
  m.name = "sheet";
  m.color1 = m.color2 = reflectance;
  m.transmission = transmission;
  m.variation = 0;
  return m;
}

/// A clear sky with the sun at 50°, of which either light can be put out.
inline SkySettings sky(float sun, float rest) {
  SkySettings s;
  s.sun = {50, 170};
  s.sun_intensity = sun;
  s.sky_intensity = rest;
  s.haze = false;
  return s;
}

/// A world and its ray tracer.
struct Stage {
  World world;
  std::unique_ptr<ModelTrees> trees;
  std::unique_ptr<RayScene> rays;

  explicit Stage(World w, double spacing = 20) : world(std::move(w)) {
    Progress progress;
    trees = std::make_unique<ModelTrees>(world.models, progress);
    rays = std::make_unique<RayScene>(world, *trees, dice_ground_evenly(world.ground, spacing),
                                      progress);
  }
};

inline Image picture(const RayScene& scene, const Camera& camera, IVec2 size, std::uint32_t samples,
                     int max_bounces, float filter_width = 1) {
  Film film(size.x, size.y);
  RenderSettings settings;
  settings.max_bounces = max_bounces;
  settings.filter_width = filter_width;
  Progress progress;
  trace_picture(scene, CameraRays(camera, size.x, size.y), settings, {{0, samples}, 1, false}, film,
                progress);
  return film.image();
}

/// Mean of the colour channels over the picture, cd/m².
inline DVec3 mean_radiance(const Image& image) {
  DVec3 sum(0);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < 3; ++c) sum[c] += static_cast<double>(image.at(x, y, c));
  return sum * static_cast<double>(white_luminance) /
         (static_cast<double>(image.width) * image.height);
}

}  // namespace wold::testing
