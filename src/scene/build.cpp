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
#include "scene/planting.hpp"
#include "scene/scene_maps.hpp"

namespace wold {

namespace {

using Clock = std::chrono::steady_clock;

// Plants lower than this do not count when a view is chosen.
constexpr float least_landmark = 1.2F;  // m
constexpr float least_tree = 4;         // m
constexpr int camera_ground_samples = 512;

/// Runs a stage and adds its time to the table.
template <class Work>
auto timed(std::map<std::string, double>& seconds, const char* stage, const Work& work) {
  const auto began = Clock::now();
  auto result = work();
  seconds[stage] += std::chrono::duration<double>(Clock::now() - began).count();
  return result;
}

/// The samples of the land around, as wide as the terrain's sides ask for.
TerrainWindow surrounding_window(const Scene& scene, const TerrainWindow& inner) {
  const DVec2 inner_size = inner.cell * DVec2(inner.width - 1, inner.height - 1);
  const DVec2 size = inner_size * static_cast<double>(scene.surroundings.factor);
  const DVec2 middle = inner.origin + 0.5 * inner_size;
  TerrainWindow window;
  window.cell = std::max(size.x, size.y) / (scene.surroundings.resolution - 1);
  window.width = std::max(2, static_cast<int>(std::ceil(size.x / window.cell - 1e-6)) + 1);
  window.height = std::max(2, static_cast<int>(std::ceil(size.y / window.cell - 1e-6)) + 1);
  window.origin = middle - 0.5 * window.cell * DVec2(window.width - 1, window.height - 1);
  return window;
}

TerrainResult build_surroundings(const Scene& scene, Progress& progress) {
  if (scene.surroundings.factor <= 1) return {};
  const TerrainWindow window = surrounding_window(scene, window_of(scene.terrain));
  return evaluate(scene.terrain, window, scene.steps, scene_operators(), scene.header.seed,
                  scene.folder, progress);
}

std::vector<CoverLayer> build_covers(const Scene& scene, const TerrainResult& terrain,
                                     const TerrainResult& around, Progress& progress) {
  const TerrainDomain place{terrain.field.origin, terrain.field.size()};
  std::vector<CoverLayer> layers;
  for (const GroundCover& cover : scene.covers) {
    const std::string& map = cover.map.path;
    Heightfield inner = scene_map(scene, map, terrain.field, terrain.maps, place, progress);
    Heightfield outer;
    if (around.maps.contains(map))
      outer = {around.maps.at(map), around.field.origin, around.field.cell};
    const auto seed = static_cast<std::uint32_t>(
        random_bits(scene.header.seed, hash_text(std::string_view("cover")), layers.size()));
    layers.emplace_back(cover, std::move(inner), std::move(outer), seed);
  }
  return layers;
}

WaterLayer build_water(const Scene& scene, const TerrainResult& ground, const Grid<float>& depth) {
  return depth.empty() ? WaterLayer() : WaterLayer(ground.field, depth, scene.water.least_depth);
}

GroundDressing dress(const Scene& scene, const TerrainResult& terrain, const TerrainResult& around,
                     Progress& progress) {
  GroundDressing dressing;
  dressing.covers = build_covers(scene, terrain, around, progress);
  dressing.water = scene.water;
  const std::string& map = scene.water.depth.path;
  const TerrainDomain place{terrain.field.origin, terrain.field.size()};
  dressing.inner_water = build_water(
      scene, terrain, scene_map(scene, map, terrain.field, terrain.maps, place, progress).height);
  if (around.maps.contains(map))
    dressing.outer_water = build_water(scene, around, around.maps.at(map));
  return dressing;
}

/// Chooses among the views of the ground and of what can be a landmark.
Camera choose_camera(const Scene& scene, const CameraSettings& settings, const BuiltScene& built,
                     Progress& progress) {
  const Ground& ground = built.world->ground;
  if (is_placed(settings)) return placed_camera(ground, settings);
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

/// Plants stand on the field; near the camera the ground is drawn with more detail than it has.
/// `spacing_angle`: distance between samples of the drawn ground over distance from the eye.
void set_on_drawn_ground(World& world, Vec3 eye, float spacing_angle) {
  parallel_for(0, static_cast<int>(world.instances.size()), [&](int k) {
    Vec3& foot = world.instances[static_cast<std::size_t>(k)].position;
    const DVec2 place(foot.x, foot.y);
    const float spacing = spacing_angle * glm::distance(foot, eye);
    foot.z += world.ground.detailed(place, spacing).height - world.ground.base(place).height;
  });
}

/// Without trees in the scene there are none in the distance.
GroundMaterial ground_material(const Scene& scene) {
  GroundMaterial material = scene.ground;
  const auto tall = [&](const std::string& name) {
    return std::any_of(scene.species.begin(), scene.species.end(), [&](const SpeciesSettings& s) {
      return s.name == name && s.height.high >= least_tree;
    });
  };
  const bool trees = std::any_of(scene.scatter.begin(), scene.scatter.end(), [&](const auto& s) {
    return s.where.within <= 0 && s.density > 0 &&
           (s.species.empty() || std::any_of(s.species.begin(), s.species.end(),
                                             [&](const auto& entry) { return tall(entry.first); }));
  });
  if (!trees) material.distant_forest = 0;
  return material;
}

void check_cover(const Scene& scene, const GroundCover& cover, const OperatorList& operators) {
  if (cover.map.empty())
    throw Error(ErrorKind::input, "a [[cover]] needs a map, such as map = \"rivers.water\"");
  check_map(scene, cover.map.path, "map", operators);
}

}  // namespace

void check_scene(const Scene& scene) {
  const auto at = [&scene](const std::string& path, const auto& check) {
    try {
      check();
    } catch (const Error& error) {
      throw error.at(scene.location(path));
    }
  };
  const OperatorList operators = scene_operators();
  at("terrain.resolution",
     [&] { check_terrain(window_of(scene.terrain), scene.steps, operators, scene.folder); });
  if (scene.surroundings.factor > 1)
    at("surroundings.resolution", [&] {
      check_terrain(surrounding_window(scene, window_of(scene.terrain)), scene.steps, operators,
                    scene.folder);
    });
  for (std::size_t k = 0; k < scene.species.size(); ++k)
    at(fmt::format("species.{}.plant", k),
       [&] { load_plant(find_scene_file(scene.species[k].plant.path, scene.folder).string()); });
  for (std::size_t k = 0; k < scene.scatter.size(); ++k)
    at(fmt::format("scatter.{}.mask", k),
       [&] { check_map(scene, scene.scatter[k].mask.path, "mask", operators); });
  at("water.depth", [&] { check_map(scene, scene.water.depth.path, "map", operators); });
  for (std::size_t k = 0; k < scene.covers.size(); ++k)
    at(fmt::format("cover.{}.map", k), [&] { check_cover(scene, scene.covers[k], operators); });
  at("sky.sun", [&] { check_sky(scene.sky); });
  for (std::size_t k = 0; k < scene.cameras.size(); ++k)
    at(fmt::format("camera.{}", k), [&] { check_camera(scene.cameras[k]); });
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
  TerrainResult around =
      timed(built.seconds, "terrain", [&] { return build_surroundings(scene, progress); });
  GroundDressing dressing = dress(scene, terrain, around, progress);
  built.maps = std::move(terrain.maps);

  PlantModels models =
      timed(built.seconds, "plants", [&] { return build_models(scene, progress); });
  built.world = std::make_unique<World>(
      World{Ground(std::move(terrain.field), std::move(around.field), ground_material(scene),
                   scene.header.seed, std::move(dressing)),
            std::move(models.materials),
            std::move(models.list),
            {},
            Sky(scene.sky)});

  built.models = timed(built.seconds, "ray tracer",
                       [&] { return std::make_unique<ModelTrees>(built.world->models, progress); });
  const Planter planter(scene, built.world->ground.field(), built.maps);
  const Ground& ground = built.world->ground;
  const auto plant = [&](Planting which) {
    timed(built.seconds, "scatter", [&] {
      const DVec2 eye(built.camera.position.x, built.camera.position.y);
      for (const Instance& p : planter.plants(which, eye, progress)) {
        if (ground.water_depth(DVec2(p.position.x, p.position.y)) > 0) continue;
        built.world->instances.push_back({p.position, p.up, p.yaw, p.scale,
                                          models.first_model[p.species] + p.model, p.individual});
        ++built.plants[scene.species[p.species].name];
      }
      return 0;
    });
  };
  plant(Planting::everywhere);
  built.camera = timed(built.seconds, "camera",
                       [&] { return choose_camera(scene, settings, built, progress); });
  plant(Planting::near_camera);
  const CameraRays rays(built.camera, scene.render.size.x, scene.render.size.y);
  set_on_drawn_ground(*built.world, built.camera.position,
                      scene.render.dicing * rays.pixel_angle());
  built.rays = timed(built.seconds, "ray tracer", [&] {
    GroundDicing dicing;
    dicing.spacing_pixels = scene.render.dicing;
    dicing.spacing_outside = 5 * scene.render.dicing;
    return std::make_unique<RayScene>(*built.world, *built.models,
                                      dice_ground(built.world->ground, built.camera, rays, dicing),
                                      progress);
  });
  return built;
}

}  // namespace wold
