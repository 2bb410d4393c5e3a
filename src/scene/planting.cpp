#include "scene/planting.hpp"

#include "scene/scene_maps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "base/hash.hpp"
#include "plants/plant.hpp"
#include "terrain/import.hpp"

namespace wold {

namespace {

/// A plant file's material as a renderer's: its colour varied a little in space.
Material material_of(const PlantMaterial& plant) {
  Material m;
  m.name = plant.name;
  m.color1 = 0.8F * plant.reflectance;
  m.color2 = 1.2F * plant.reflectance;
  m.transmission = plant.transmittance;
  m.roughness = plant.roughness;
  const bool wood = plant.name.find("bark") != std::string::npos || plant.name == "twig";
  m.feature_size = wood ? 0.06F : 0.5F;
  m.stretch = wood ? 4.0F : 1.0F;
  m.variation = wood ? 0.08F : 0.16F;
  return m;
}

/// Finds or makes the material of a part of a species: the scene's "species.part" or "part", the
/// standard "species.part", the plant file's own, the standard "part".
class Materials {
 public:
  explicit Materials(const Scene& scene) : scene_(scene) {}

  std::uint32_t index_of(const SpeciesSettings& species, const std::string& part,
                         const Plant& plant) {
    const std::string key = species.name + "." + part;
    if (const auto found = index_.find(key); found != index_.end()) return found->second;
    list.emplace_back(find(key, part, plant), species.tint);
    const auto index = static_cast<std::uint32_t>(list.size() - 1);
    index_.emplace(key, index);
    return index;
  }

  std::vector<SurfaceMaterial> list;

 private:
  Material find(const std::string& key, const std::string& part, const Plant& plant) const {
    for (const std::string& name : {key, part})
      for (const Material& m : scene_.materials)
        if (m.name == name) return m;
    const auto standard = [](const std::string& name) -> const Material* {
      for (const Material& m : standard_materials())
        if (m.name == name) return &m;
      return nullptr;
    };
    const std::string own = plant.name + "." + part;
    if (const Material* m = standard(own)) return *m;
    if (const PlantMaterial* m = plant.find_material(part)) return material_of(*m);
    if (const Material* m = standard(part)) return *m;
    Material grey;
    grey.name = part;
    return grey;
  }

  const Scene& scene_;
  std::map<std::string, std::uint32_t> index_;
};

}  // namespace

PlantModels build_models(const Scene& scene, Progress& progress) {
  Materials materials(scene);
  std::vector<SpeciesSettings> settings = scene.species;
  for (SpeciesSettings& s : settings)
    s.plant.path = find_scene_file(s.plant.path, scene.folder).string();
  PlantModels models;
  for (Species& species : grow_species(settings, scene.header.seed, progress)) {
    models.first_model.push_back(static_cast<std::uint32_t>(models.list.size()));
    for (TriangleMesh& mesh : species.models) {
      Model model;
      for (const MeshPart& part : mesh.parts)
        model.part_materials.push_back(
            materials.index_of(species.settings, part.material, species.plant));
      model.mesh = std::move(mesh);
      models.list.push_back(std::move(model));
    }
  }
  models.materials = std::move(materials.list);
  return models;
}

std::uint64_t scatter_seed(const Scene& scene, std::size_t k) {
  return random_bits(scene.header.seed, hash_text(std::string_view("scatter")), k);
}

std::vector<Instance> Planter::plants(Planting which, DVec2 camera, Progress& progress) const {
  const bool near_camera = which == Planting::near_camera;
  std::vector<Instance> all;
  const auto add = [&](const std::vector<Instance>& some) {
    all.insert(all.end(), some.begin(), some.end());
  };
  for (std::size_t k = 0; k < scene_.scatter.size(); ++k) {
    const ScatterSettings& settings = scene_.scatter[k];
    if ((settings.where.within > 0) != near_camera) continue;
    const Heightfield mask = scene_map(scene_, settings.mask.path, field_, maps_,
                                       TerrainDomain{field_.origin, field_.size()}, progress);
    ScatterPlace place;
    place.low = field_.origin;
    place.high = field_.origin + field_.size();
    place.centre = camera;
    place.mask = mask.height.empty() ? nullptr : &mask;
    add(scatter(field_, settings, scene_.species, place, scatter_seed(scene_, k), progress));
  }
  for (std::size_t k = 0; k < scene_.grids.size(); ++k) {
    const GridSpawner& grid = scene_.grids[k];
    if ((grid.around == GridCentre::camera) != near_camera) continue;
    const DVec2 centre = near_camera ? camera : DVec2(0);
    add(spawn_grid(field_, grid, scene_.species, centre,
                   random_bits(scene_.header.seed, hash_text(std::string_view("grid")), k)));
  }
  return all;
}

}  // namespace wold
