#pragma once
// A heightfield as a triangle mesh: one vertex per sample, two triangles per cell, split along the
// diagonal whose ends differ less in height (so crests and valleys are not cut across).

#include "base/mesh.hpp"
#include "terrain/heightfield.hpp"

namespace wold {

/// Positions in the world, m; normals of the bicubic surface; uv from (0, 0) in the south-west to
/// (1, 1) in the north-east; one part, "ground". Throws Error(limit) where it would not fit in
/// memory or exceeds 2^32 vertices, Error(input) for fewer than 2 x 2 samples.
TriangleMesh mesh_of(const Heightfield& field);

}  // namespace wold
