#pragma once
// From a scene to something that can be traced: ground, models, plants in their places, camera.

#include <map>
#include <memory>
#include <string>

#include "render/ray_scene.hpp"
#include "scene/scene.hpp"

namespace wold {

/// A scene made ready to render for one camera.
struct BuiltScene {
  std::unique_ptr<World> world;
  std::unique_ptr<ModelTrees> models;  ///< of world->models
  std::unique_ptr<RayScene> rays;      ///< refers to *world and *models
  Camera camera;
  std::map<std::string, Grid<float>> maps;  ///< of the terrain's steps, over world->ground.field()
  std::map<std::string, double> seconds;    ///< by stage
  std::map<std::string, std::uint64_t> plants;  ///< instances by species
};

/// Paths in the scene that cannot be read, species and operators that do not exist, sizes that
/// cannot fit: throws what `build` would, in little time.
void check_scene(const Scene& scene);

/// The terrain alone. Throws as `evaluate`.
TerrainResult build_terrain(const Scene& scene, Progress& progress);

/// Builds all. `camera` names one of the scene's cameras, empty for the first. Throws Error.
BuiltScene build(const Scene& scene, const std::string& camera, Progress& progress);

}  // namespace wold
