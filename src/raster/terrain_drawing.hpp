#pragma once
// The ground of a scene drawn with triangles: tiles by distance (terrain_levels.hpp), heights,
// colours and normals from textures and noises on the device (ground_textures.hpp), the same as the
// path tracer's.
//
// It ends where the modelled ground ends; what lies beyond is the sky's, whose directions below the
// horizon show a hazy plain.

#include <array>

#include "raster/draw_view.hpp"
#include "raster/ground_textures.hpp"
#include "raster/scene_light.hpp"
#include "raster/terrain_levels.hpp"

namespace wold {

class TerrainDrawing {
 public:
  /// Keeps a reference to the ground. Throws as GpuProgram.
  explicit TerrainDrawing(const Ground& ground, const TerrainDetail& detail = {});

  /// Draws into the current target; reversed depth test is expected to be on. `light` may be null
  /// where the view is `depth_only`.
  void draw(const DrawView& view, const SceneLight* light);

  /// Another ground, or the same with other heights, maps or material.
  void update(const Ground& ground);

  void set_detail(const TerrainDetail& detail) { detail_ = detail; }
  const TerrainDetail& detail() const { return detail_; }
  const TerrainLevels& levels() const { return levels_; }
  /// Of the last drawing.
  std::size_t drawn_triangles() const { return drawn_triangles_; }

 private:
  /// The grid that all tiles share, of so many cells.
  struct TileMesh {
    GpuVertices vertices;
    GpuBuffer corners;
    GpuBuffer indices;
    int index_count = 0;
  };

  const TileMesh& mesh(int cells);

  TerrainDetail detail_;
  TerrainLevels levels_;
  GroundTextures textures_;
  GpuProgram color_program_;
  GpuProgram depth_program_;
  GpuBuffer tiles_;
  std::array<TileMesh, 3> meshes_;  // of 8, 16 and 32 cells
  std::size_t drawn_triangles_ = 0;
};

}  // namespace wold
