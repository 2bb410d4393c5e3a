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

/// 1 - hardness, from the map of that name; 1 without.
Grid<float> ease_of(const Heightfield& input, const std::string& hardness, bool invert,
                    const TerrainContext& context);

/// Depths of the map of that name, m; 0 without. Throws Error(input) for depths above 300 m.
Grid<float> depth_map(const Heightfield& input, const std::string& name,
                      const TerrainContext& context);

/// The input with its change and with what is still in the water; "wear" and "sediment" go to the
/// maps.
Heightfield changed_ground(const Heightfield& input, const Grid<Grains>& change,
                           const Grid<Grains>& carried, std::map<std::string, Grid<float>>& maps);

}  // namespace wold::pipes_detail
