#pragma once
// A scene drawn in real time: its land, its plants, its light.

#include <functional>
#include <optional>
#include <vector>

#include "base/background_job.hpp"
#include "raster/picture_drawing.hpp"
#include "raster/plant_drawing.hpp"
#include "raster/terrain_drawing.hpp"
#include "scene/planted_world.hpp"

namespace wold {

struct SceneDetail {
  TerrainDetail terrain;
  PlantDetail plants;
  PictureQuality picture;
  ShadowSettings shadows;
};

/// How fine a scene is drawn: `low` for a processor that draws itself, `medium` for a graphics
/// card, `high` for stills and films.
enum class DrawingQuality { low, medium, high };

SceneDetail scene_detail(DrawingQuality quality);

class SceneDrawing {
 public:
  /// Keeps a reference to `world`. Needs a current context. Throws as GpuProgram, and
  /// Error(cancelled).
  SceneDrawing(const PlantedWorld& world, const SceneDetail& detail, Progress& progress);

  void resize(int width, int height) { picture_.resize(width, height); }
  /// Draws one frame more (PictureDrawing::draw). Plants that stand around the eye only are found
  /// anew, in the background, once it has moved on.
  /// `extra`, if given, draws more surfaces, seen but without shadows.
  void draw(const Camera& camera, const std::function<void(const DrawView&)>& extra = {});

  /// Waits until everything that a camera sees is there: for stills and films.
  void settle(const Camera& camera);

  /// Another moment over the same land.
  void set_sky(const SkySettings& sky);
  /// Another world in place of this one; keeps what draws plants whose models are the same. Throws
  /// as the constructor.
  void replace(const PlantedWorld& world, Progress& progress);

  PictureDrawing& picture() { return picture_; }
  const PictureDrawing& picture() const { return picture_; }
  const SceneLight& light() const { return light_; }
  std::size_t drawn_triangles() const;

 private:
  struct NearPlants {
    std::vector<ModelInstance> plants;
    CanopyShade shade;
  };

  void stand_plants();
  void shade_land(const Ground& ground);
  void set_sun();
  void find_near_plants(const Camera& camera);
  bool take_near_plants();
  void set_near_plants(const NearPlants& found);

  const PlantedWorld* world_;
  SceneLight light_;
  SunShadowMap sun_shadows_;
  TerrainDrawing terrain_;
  PlantDrawing plants_;
  PictureDrawing picture_;
  std::optional<DVec2> near_eye_;  // the eye that the plants around it were last asked for
  BackgroundJob<NearPlants> finding_near_;
};

}  // namespace wold
