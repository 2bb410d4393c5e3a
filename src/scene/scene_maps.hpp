#pragma once
// Maps that sections of a scene name: those that terrain steps make, and pictures.

#include <map>
#include <string>

#include "scene/scene.hpp"

namespace wold {

/// Throws Error(input) when `name` is neither a map that a step makes nor a picture that is there;
/// `what` begins the message. An empty name is none.
void check_map(const Scene& scene, const std::string& name, const char* what,
               const OperatorList& operators);

/// The map of that name among `maps` (over the samples of `field`), or a picture over `place`;
/// empty where the name is. Throws Error(io) for a picture that cannot be read.
Heightfield scene_map(const Scene& scene, const std::string& name, const Heightfield& field,
                      const std::map<std::string, Grid<float>>& maps, const TerrainDomain& place,
                      Progress& progress);

}  // namespace wold
