#pragma once
// A scene drawn in real time: its land, its plants, its light.

#include <functional>
#include <memory>
#include <vector>

#include "raster/picture_drawing.hpp"
#include "raster/terrain_drawing.hpp"
#include "scene/planted_world.hpp"

namespace wold {

struct SceneDetail {
  TerrainDetail terrain;
  PictureQuality picture;
  ShadowSettings shadows;
};

/// What suits the driver: a processor draws less.
SceneDetail suitable_detail(bool software);

class SceneDrawing {
 public:
  /// Keeps a reference to `world`. Needs a current context. Throws as GpuProgram, and
  /// Error(cancelled).
  SceneDrawing(const PlantedWorld& world, const SceneDetail& detail, Progress& progress);

  void resize(int width, int height) { picture_.resize(width, height); }
  /// Draws one frame more (PictureDrawing::draw). Plants that stand around the eye only are found
  /// anew once it has moved on.
  /// `extra`, if given, draws more surfaces, seen but without shadows.
  void draw(const Camera& camera, const std::function<void(const DrawView&)>& extra = {});

  /// Another moment over the same land.
  void set_sky(const SkySettings& sky);
  /// The ground's heights, maps or colours have changed.
  void update_ground(const Ground& ground);

  PictureDrawing& picture() { return picture_; }
  const PictureDrawing& picture() const { return picture_; }
  const SceneLight& light() const { return light_; }
  std::size_t drawn_triangles() const;

 private:
  void shade_land(const Ground& ground);
  void set_sun();

  const PlantedWorld& world_;
  SceneLight light_;
  SunShadowMap sun_shadows_;
  TerrainDrawing terrain_;
  PictureDrawing picture_;
};

}  // namespace wold
