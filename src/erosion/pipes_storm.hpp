#pragma once
// The whole work of `pipes` on one piece of land, for rock of any kind.

#include <functional>

#include "erosion/pipes_solver.hpp"

namespace wold::pipes_detail {

/// Says what the ground is made of, for a grid of the ladder: its ground as it was at first, the
/// change so far, and the ease that hardness maps give. An empty result is one material.
using RockFunction = std::function<MaterialFunction(
    const Heightfield& ground, const Grid<Grains>& change, const Grid<float>& ease)>;

/// Throws as `pipes` does, but for the checks of ground and parameters.
TerrainResult storm(const Heightfield& input, const Pipes& parameters,
                    const TerrainContext& context, const RockFunction& rock = {});

}  // namespace wold::pipes_detail
