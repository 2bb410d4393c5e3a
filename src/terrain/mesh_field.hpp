#pragma once
// A mesh as ground: its surface as seen from above becomes a heightfield, and what happens to the
// heightfield is carried back to the mesh.
//
//   EditableMesh mesh = EditableMesh::read("island.glb");
//   MeshProjection ground(mesh.positions(), mesh.triangles(), {}, progress);
//   const Heightfield eroded = …(ground.field())…;
//   ground.displace(mesh.positions(), eroded);
//   mesh.write("eroded.glb");
//
// Sample (i, j) is as high as the highest triangle over it. Without a given cell it is the mesh's
// own spacing: on a regular grid of vertices along the axes each sample lies on a vertex, so that
// nothing is lost between them and nothing invented. Where no triangle is, heights go on smoothly
// from the border of what is covered (they solve Laplace's equation, on a pyramid of grids), so
// that water flows on over an uneven outline and over holes.
//
// Back to the mesh goes the difference of the heights before and after, bilinearly at each vertex
// that can be seen from above, within a tolerance. What lies beneath stays: bottoms, caves, the
// feet of walls.

#include <cstdint>
#include <span>
#include <vector>

#include "base/progress.hpp"
#include "terrain/heightfield.hpp"

namespace wold {

struct ProjectionSettings {
  double cell = 0;     ///< m, between samples; 0: from `resolution`
  int resolution = 0;  ///< samples along the longer side; 0: as many as the mesh has vertices
  double scale = 1;    ///< m, the unit of the mesh
  double tolerance =
      0;  ///< m below the surface that a vertex may lie to move; 0: a tenth of a cell
};

/// Samples along the longer side at most, if nobody asks for more.
inline constexpr int most_projected_samples = 8193;

class MeshProjection {
 public:
  /// Positions in units of the mesh, Z up. Throws Error(input) for a mesh without triangles or
  /// without any that can be seen from above, for positions that are not finite and for an extent
  /// of 0; Error(limit) where the samples would not fit in memory; Error(cancelled).
  MeshProjection(std::span<const DVec3> positions, std::span<const UVec3> triangles,
                 const ProjectionSettings& settings, Progress& progress);

  /// m, in the world: a place of the mesh times the scale.
  const Heightfield& field() const { return field_; }
  /// 1 where a triangle gave the height, 0 where it was filled in.
  const Grid<std::uint8_t>& covered() const { return covered_; }
  /// Per vertex: 1 if it lies on the surface that was projected, so that `displace` moves it.
  std::span<const std::uint8_t> on_surface() const { return on_surface_; }

  /// Adds `after` - field() to the heights of the positions, which are those that were projected.
  /// Returns how many vertices lie on the surface. Throws Error(internal) for a field of another
  /// shape or other positions; Error(input) if `after` has values that are not finite.
  std::size_t displace(std::span<DVec3> positions, const Heightfield& after) const;

 private:
  Heightfield field_;
  Grid<std::uint8_t> covered_;
  std::vector<std::uint8_t> on_surface_;
  double scale_ = 1;
};

/// The lower quartile of the edges' lengths in plan: on a grid of squares or their halves the side
/// of the squares. 0 without edges.
double spacing_in_plan(std::span<const DVec3> positions, std::span<const UVec3> triangles);

/// Gives the samples that are not covered heights that go on smoothly from those that are.
void fill_uncovered(Grid<float>& height, const Grid<std::uint8_t>& covered, Progress& progress);

}  // namespace wold
