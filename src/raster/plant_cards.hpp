#pragma once
// Pictures of plants, for where a plant is lower than some dozens of pixels: drawn once from eight
// directions around at two heights, then shown on a rectangle that faces the eye and is upright as
// the plant.
//
// A picture has albedo and coverage, the normals of what is seen, which part is leaves, and the
// light let through to it (plant_openness.hpp): so that it is lit as the mesh is, from anywhere.
// Between directions pixels of one and the other are mixed, so that none is seen to turn. Coverage
// is a part, and is drawn as the chance that a pixel is (hashed alpha testing: C. Wyman, M.
// McGuire, I3D 2017), another one each frame: the mean over frames (PictureDrawing) has crowns as
// fine and as thin as they are at any distance.

#include <functional>
#include <vector>

#include "raster/plant_choice.hpp"
#include "raster/scene_light.hpp"

namespace wold {

/// What a card needs to know of its model.
struct CardShape {
  float radius = 1;      ///< m, about the stem
  float low = 0;         ///< m
  float high = 1;        ///< m
  Vec3 transmission{0};  ///< of leaves, relative to their reflectance
  float roughness = 0;   ///< of leaves
  float tint = 0;        ///< between individuals
};

CardShape card_shape(const PlantLevels& levels, const std::vector<SurfaceMaterial>& materials);

class PlantCards {
 public:
  explicit PlantCards(int models);

  /// Draws the pictures of a model; `draw` draws it at the origin with a program given. Changes the
  /// target and the depth test.
  void picture(int model, const CardShape& shape,
               const std::function<void(const GpuProgram&)>& draw);
  /// Draws the plants of a batch. Null `light` for depth alone.
  void draw(int model, const DrawView& view, const SceneLight* light, const GpuBuffer& plants,
            const PlantBatch& batch) const;

 private:
  GpuProgram picture_program_;
  GpuProgram color_program_;
  GpuProgram depth_program_;
  GpuTarget target_;
  GpuTexture albedo_;
  GpuTexture normal_;
  GpuTexture light_;
  GpuVertices vertices_;
  GpuBuffer corners_;
  std::vector<CardShape> shapes_;
};

}  // namespace wold
