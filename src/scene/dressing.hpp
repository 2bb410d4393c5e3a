#pragma once
// What lies and grows on a scene's land: covers, water, and how densely trees stand.

#include <map>
#include <string>

#include "render/ground.hpp"
#include "scene/scene.hpp"

namespace wold {

/// Covers and water from the maps that the terrain's steps made, and from pictures. `around` may be
/// empty. Throws Error(io) for a picture that cannot be read.
GroundDressing dress_ground(const Scene& scene, const TerrainResult& terrain,
                            const TerrainResult& around, Progress& progress);

/// Whether a kind grows as high as a tree.
bool is_tree(const SpeciesSettings& species);
/// Whether there are trees in a scatter of the scene.
bool plants_trees(const Scene& scene, const ScatterSettings& scatter);

/// Trees per m² of map at the samples of the field: what the scatters ask for, also where they
/// stand around the camera only; empty without trees. Throws as dress_ground, and Error(input) for
/// a kind that the scene does not have.
Grid<float> tree_density(const Scene& scene, const Heightfield& field,
                         const std::map<std::string, Grid<float>>& maps, Progress& progress);

}  // namespace wold
