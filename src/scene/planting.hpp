#pragma once
// Plants of a scene: their models with materials, and where they stand.

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "render/world.hpp"
#include "scene/scene.hpp"

namespace wold {

/// All models, species after species; `first_model[s]` is where species s begins.
struct PlantModels {
  std::vector<Model> list;
  std::vector<SurfaceMaterial> materials;
  std::vector<std::uint32_t> first_model;
};

/// Grows the models of all species. Throws as `grow_species`; Error(io) for plant files that are
/// not there.
PlantModels build_models(const Scene& scene, Progress& progress);

/// The plants that stand around the camera, or those that stand without regard to it.
enum class Planting { everywhere, near_camera };

/// Of the scene's k-th scatter.
std::uint64_t scatter_seed(const Scene& scene, std::size_t k);

/// Where plants of a scene stand on a field. `maps` are the terrain's; `camera` matters to plants
/// near it only.
class Planter {
 public:
  Planter(const Scene& scene, const Heightfield& field,
          const std::map<std::string, Grid<float>>& maps)
      : scene_(scene), field_(field), maps_(maps) {}

  /// Throws as `scatter` and `spawn_grid`.
  std::vector<Instance> plants(Planting which, DVec2 camera, Progress& progress) const;

 private:
  const Scene& scene_;
  const Heightfield& field_;
  const std::map<std::string, Grid<float>>& maps_;
};

}  // namespace wold
