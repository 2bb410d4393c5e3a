#include "scene/build.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "base/hash.hpp"
#include "base/memory.hpp"
#include "base/parallel.hpp"
#include "plants/plant.hpp"
#include "render/ground_mesh.hpp"
#include "terrain/import.hpp"

namespace wold {

namespace {

using Clock = std::chrono::steady_clock;

// Plants lower than this do not count when a view is chosen.
constexpr float least_landmark = 1.2F;  // m
constexpr int camera_ground_samples = 512;

/// Runs a stage and adds its time to the table.
template <class Work>
auto timed(std::map<std::string, double>& seconds, const char* stage, const Work& work) {
  const auto began = Clock::now();
  auto result = work();
  seconds[stage] += std::chrono::duration<double>(Clock::now() - began).count();
  return result;
}

Heightfield build_surroundings(const Scene& scene, const Heightfield& field, Progress& progress) {
  if (scene.surroundings.factor <= 1) return {};
  const DVec2 size = field.size() * static_cast<double>(scene.surroundings.factor);
  const DVec2 middle = field.origin + 0.5 * field.size();
  const double cell = std::max(size.x, size.y) / (scene.surroundings.resolution - 1);
  TerrainWindow window;
  window.cell = cell;
  window.width = static_cast<int>(std::lround(size.x / cell)) + 1;
  window.height = static_cast<int>(std::lround(size.y / cell)) + 1;
  window.origin = middle - 0.5 * cell * DVec2(window.width - 1, window.height - 1);
  return evaluate(scene.terrain, window, scene.steps, scene_operators(), scene.header.seed,
                  scene.folder, progress)
      .field;
}

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

  std::uint32_t index_of(const std::string& species, const std::string& part, const Plant& plant) {
    const std::string key = species + "." + part;
    if (const auto found = index_.find(key); found != index_.end()) return found->second;
    list.emplace_back(find(key, part, plant));
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

/// All models, species after species; `first_model[s]` is where species s begins.
struct Models {
  std::vector<Model> list;
  std::vector<std::uint32_t> first_model;
};

Models build_models(const Scene& scene, Materials& materials, Progress& progress) {
  std::vector<SpeciesSettings> settings = scene.species;
  for (SpeciesSettings& s : settings)
    s.plant.path = find_scene_file(s.plant.path, scene.folder).string();
  Models models;
  for (Species& species : grow_species(settings, scene.header.seed, progress)) {
    models.first_model.push_back(static_cast<std::uint32_t>(models.list.size()));
    for (TriangleMesh& mesh : species.models) {
      Model model;
      for (const MeshPart& part : mesh.parts)
        model.part_materials.push_back(
            materials.index_of(species.settings.name, part.material, species.plant));
      model.mesh = std::move(mesh);
      models.list.push_back(std::move(model));
    }
  }
  return models;
}

class Planter {
 public:
  Planter(const Scene& scene, const Models& models, BuiltScene& built)
      : scene_(scene), models_(models), built_(built) {}

  /// Scatters what does (or does not) stand only near the camera.
  void plant(bool near_camera, Progress& progress) {
    const Heightfield& field = built_.world->ground.field();
    for (std::size_t k = 0; k < scene_.scatter.size(); ++k) {
      const ScatterSettings& settings = scene_.scatter[k];
      if ((settings.where.within > 0) != near_camera) continue;
      const Heightfield mask = mask_of(settings, progress);
      ScatterPlace place;
      place.low = field.origin;
      place.high = field.origin + field.size();
      place.centre = DVec2(built_.camera.position.x, built_.camera.position.y);
      place.mask = mask.height.empty() ? nullptr : &mask;
      const auto seed = random_bits(scene_.header.seed, hash_text(std::string_view("scatter")), k);
      add(scatter(field, settings, scene_.species, place, seed, progress));
    }
  }

 private:
  /// A map that a terrain step made, or a picture over the whole terrain; empty when none is asked
  /// for.
  Heightfield mask_of(const ScatterSettings& settings, Progress& progress) const {
    if (settings.mask.empty()) return {};
    const Heightfield& field = built_.world->ground.field();
    Heightfield mask = field;
    if (const auto map = built_.maps.find(settings.mask.path); map != built_.maps.end()) {
      mask.height = map->second;
    } else {
      const auto file = find_scene_file(settings.mask.path, scene_.folder);
      mask.height =
          picture_over(file, "", TerrainDomain{field.origin, field.size()}, field, progress);
    }
    return mask;
  }

  void add(const std::vector<Instance>& plants) {
    for (const Instance& plant : plants) {
      ModelInstance m;
      m.position = plant.position;
      m.up = plant.up;
      m.yaw = plant.yaw;
      m.scale = plant.scale;
      m.model = models_.first_model[plant.species] + plant.model;
      m.individual = plant.individual;
      built_.world->instances.push_back(m);
      ++built_.plants[scene_.species[plant.species].name];
    }
  }

  const Scene& scene_;
  const Models& models_;
  BuiltScene& built_;
};

/// Chooses among the views of the ground and of what can be a landmark.
Camera choose_camera(const Scene& scene, const CameraSettings& settings, const BuiltScene& built,
                     Progress& progress) {
  const Ground& ground = built.world->ground;
  World landmarks{ground, {}, {}, {}, built.world->sky};
  std::vector<float> heights;
  for (const Model& model : built.world->models) heights.push_back(model.mesh.bounds().high.z);
  for (const ModelInstance& m : built.world->instances)
    if (heights[m.model] * m.scale >= least_landmark) landmarks.instances.push_back(m);
  const DVec2 extent = ground.high() - ground.low();
  const double spacing = std::max(extent.x, extent.y) / camera_ground_samples;
  const RayScene rays(landmarks, *built.models, dice_ground_evenly(ground, spacing), progress);
  const float aspect =
      static_cast<float>(scene.render.size.x) / static_cast<float>(scene.render.size.y);
  return find_camera(rays, settings, aspect, scene.header.seed, progress);
}

}  // namespace

void check_scene(const Scene& scene) {
  check_terrain(window_of(scene.terrain), scene.steps, scene_operators(), scene.folder);
  for (const SpeciesSettings& species : scene.species)
    load_plant(find_scene_file(species.plant.path, scene.folder).string());
  const Sky sky(scene.sky);
}

TerrainResult build_terrain(const Scene& scene, Progress& progress) {
  return evaluate(scene.terrain, scene.steps, scene_operators(), scene.header.seed, scene.folder,
                  progress);
}

BuiltScene build(const Scene& scene, const std::string& camera, Progress& progress) {
  check_scene(scene);
  const CameraSettings& settings = scene.camera(camera);
  BuiltScene built;
  TerrainResult terrain =
      timed(built.seconds, "terrain", [&] { return build_terrain(scene, progress); });
  Heightfield around = timed(built.seconds, "terrain",
                             [&] { return build_surroundings(scene, terrain.field, progress); });
  built.maps = std::move(terrain.maps);

  Materials materials(scene);
  Models models =
      timed(built.seconds, "plants", [&] { return build_models(scene, materials, progress); });
  built.world = std::make_unique<World>(
      World{Ground(std::move(terrain.field), std::move(around), scene.ground, scene.header.seed),
            std::move(materials.list),
            std::move(models.list),
            {},
            Sky(scene.sky)});

  built.models = timed(built.seconds, "ray tracer",
                       [&] { return std::make_unique<ModelTrees>(built.world->models, progress); });
  Planter planter(scene, models, built);
  const auto plant = [&](bool near_camera) {
    return timed(built.seconds, "scatter", [&] {
      planter.plant(near_camera, progress);
      return 0;
    });
  };
  plant(false);
  built.camera = timed(built.seconds, "camera",
                       [&] { return choose_camera(scene, settings, built, progress); });
  plant(true);
  built.rays = timed(built.seconds, "ray tracer", [&] {
    GroundDicing dicing;
    dicing.spacing_pixels = scene.render.dicing;
    dicing.spacing_outside = 5 * scene.render.dicing;
    const CameraRays rays(built.camera, scene.render.size.x, scene.render.size.y);
    return std::make_unique<RayScene>(*built.world, *built.models,
                                      dice_ground(built.world->ground, built.camera, rays, dicing),
                                      progress);
  });
  return built;
}

}  // namespace wold
