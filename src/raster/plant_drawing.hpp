#pragma once
// The plants of a world drawn with triangles: near ones leaf by leaf, farther ones with fewer and
// larger leaves (plant_levels.hpp), far ones as pictures of themselves (plant_cards.hpp); which,
// plant_choice.hpp decides anew for each view.
//
// Colours are those of the path tracer: the same two-coloured textures, the same tint of each
// individual and leaf (render/material.hpp). Light is that of raster/light.glsl, less what a
// plant's own crown keeps from its inner leaves (plant_openness.hpp).

#include <memory>
#include <span>
#include <vector>

#include "base/progress.hpp"
#include "raster/plant_cards.hpp"
#include "raster/plant_choice.hpp"
#include "raster/scene_light.hpp"
#include "render/world.hpp"

namespace wold {

class PlantDrawing {
 public:
  /// Levels and pictures of all models; world.instances stand from the start. Keeps nothing of the
  /// world. Throws Error(cancelled), and as GpuProgram.
  PlantDrawing(const World& world, Progress& progress, const PlantDetail& detail = {});

  /// Others stand than before: of the models given to the constructor.
  void set_plants(std::span<const ModelInstance> plants);
  /// Those that stand around the eye only, besides.
  void set_near_plants(std::span<const ModelInstance> plants);
  void set_detail(const PlantDetail& detail) { detail_ = detail; }
  const PlantDetail& detail() const { return detail_; }

  /// Draws into the current target; reversed depth test is expected to be on. `light` may be null
  /// where the view is `depth_only`.
  void draw(const DrawView& view, const SceneLight* light);

  /// Of the last drawing.
  const PlantChoice& choice() const { return choice_; }
  const std::vector<PlantLevels>& levels() const { return levels_; }

 private:
  struct ModelBuffers {
    GpuVertices vertices;
    GpuBuffer corners;
    GpuBuffer indices;
    int first_material = 0;
  };

  void upload(const World& world);
  void make_cards(const World& world, Progress& progress);
  void draw_batch(const GpuProgram& program, const PlantBatch& batch) const;
  void draw_cards(const DrawView& view, const SceneLight* light) const;

  PlantDetail detail_;
  std::vector<PlantLevels> levels_;
  std::vector<PlantSizes> sizes_;
  PlantField field_;
  PlantField near_field_;
  PlantChoice choice_;
  GpuProgram color_program_;
  GpuProgram depth_program_;
  GpuTexture materials_;
  std::vector<ModelBuffers> models_;
  GpuBuffer drawn_;
  std::unique_ptr<PlantCards> cards_;
};

/// The attributes of DrawnPlant from `first` on, at locations 6 to 10.
void plant_attributes(const GpuVertices& vertices, const GpuBuffer& plants, std::size_t first);

/// `view_projection` of what is relative to the eye.
Mat4 from_eye(const DrawView& view);

}  // namespace wold
