#pragma once
// Levels of plants as meshes: twin of "raster/plant_place.glsl".

#include "base/mesh.hpp"
#include "raster/plant_levels.hpp"

namespace wold {

/// Growth in area of what is kept at a share: of leaves, and of what grows in width alone.
float leaf_growth(float share);
float strip_growth(float share);

/// The triangles of a level at a share, as the vertex shader places them. One part per slot.
TriangleMesh plant_mesh_at(const PlantLevels& levels, bool is_fine, float share);

}  // namespace wold
