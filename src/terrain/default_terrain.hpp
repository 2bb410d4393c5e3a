#pragma once
// The ground of a scene that says nothing about it: wooded hills of a few hundred metres around a
// valley.

#include "terrain/steps.hpp"

namespace wold {

/// Broad hills, minus winding valleys, bent sideways; then fine detail and soft valley floors.
/// Needs the operators fbm, ridged, warp and smooth_floor in the list.
std::vector<TerrainStep> default_terrain(std::span<const TerrainOperator> operators);

}  // namespace wold
