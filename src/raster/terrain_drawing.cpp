#include "raster/terrain_drawing.hpp"

#include <epoxy/gl.h>

#include <cstdint>
#include <glm/ext/matrix_double4x4.hpp>
#include <glm/ext/vector_double4.hpp>
#include <vector>

#include "gpu/context.hpp"

namespace wold {

namespace {

GpuProgram terrain_program(const char* fragment) {
  const ShaderDialect dialect = gpu_info().dialect;
  return {assemble_shader("raster/terrain.vert.glsl", dialect), assemble_shader(fragment, dialect)};
}

/// `view_projection` of what is relative to the eye, in double: far from the world's origin little
/// is left of the difference in float.
Mat4 from_eye(const DrawView& view) {
  const glm::dmat4 m(view.view_projection);
  Mat4 out = view.view_projection;
  out[3] = Vec4(m * glm::dvec4(DVec3(view.eye), 1));
  return out;
}

}  // namespace

TerrainDrawing::TerrainDrawing(const Ground& ground, const TerrainDetail& detail)
    : detail_(detail),
      levels_(ground),
      textures_(ground),
      color_program_(terrain_program("raster/terrain.frag.glsl")),
      depth_program_(terrain_program("raster/terrain_depth.frag.glsl")),
      tiles_(std::span<const std::byte>{}, true) {}

void TerrainDrawing::update(const Ground& ground) {
  levels_ = TerrainLevels(ground);
  textures_.update(ground);
}

const TerrainDrawing::TileMesh& TerrainDrawing::mesh(int cells) {
  TileMesh& m = meshes_[cells == 8 ? 0 : cells == 16 ? 1 : 2];
  if (m.index_count > 0) return m;
  std::vector<Vec2> corners;
  for (int j = 0; j <= cells; ++j)
    for (int i = 0; i <= cells; ++i) corners.emplace_back(i, j);
  std::vector<std::uint16_t> indices;
  for (int j = 0; j < cells; ++j)
    for (int i = 0; i < cells; ++i) {
      const int at = j * (cells + 1) + i;
      for (const int k : {at, at + 1, at + cells + 2, at, at + cells + 2, at + cells + 1})
        indices.push_back(static_cast<std::uint16_t>(k));
    }
  m.corners = GpuBuffer::of(std::span<const Vec2>(corners));
  m.indices = GpuBuffer::of(std::span<const std::uint16_t>(indices));
  m.vertices.attribute(m.corners, {.location = 0, .components = 2, .stride = sizeof(Vec2)});
  m.vertices.attribute(
      tiles_,
      {.location = 1, .components = 3, .stride = sizeof(TerrainTile), .per_instance = true});
  m.vertices.indices(m.indices);
  m.index_count = static_cast<int>(indices.size());
  return m;
}

void TerrainDrawing::draw(const DrawView& view, const SceneLight* light) {
  // Shadow maps too have the camera's vertices: coarser ones throw shadows on these.
  const TerrainChoice choice = levels_.choose(view, detail_);
  const TileMesh& grid = mesh(choice.cells);
  drawn_triangles_ = choice.tiles.size() * static_cast<std::size_t>(grid.index_count) / 3;
  if (choice.tiles.empty()) return;
  textures_.move_anchor(choice.anchor);
  const bool depth_only = view.depth_only || light == nullptr;
  const GpuProgram& program = depth_only ? depth_program_ : color_program_;
  textures_.apply(program);
  view.apply(program);
  if (!depth_only) light->apply(program);
  program.set("from_eye", from_eye(view));
  program.set("terrain_eye", choice.eye);
  program.set("terrain_unit", static_cast<float>(choice.unit));
  program.set("terrain_nearest", choice.nearest);
  program.set("terrain_reach", choice.reach);
  program.set("terrain_morph", choice.morph_start);
  program.set("terrain_coarsest", choice.coarsest);
  tiles_.assign(std::as_bytes(std::span(choice.tiles)));
  grid.vertices.bind();
  glDrawElementsInstanced(GL_TRIANGLES, grid.index_count, GL_UNSIGNED_SHORT, nullptr,
                          static_cast<GLsizei>(choice.tiles.size()));
  gl::check("drawing the ground");
}

}  // namespace wold
