#include "scene/build.hpp"

#include <fmt/format.h>

#include <chrono>

#include "plants/plant.hpp"
#include "scene/planted_world.hpp"
#include "scene/scene_maps.hpp"

namespace wold {

namespace {

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
  const CameraSettings& settings = scene.camera(camera);
  PlantedWorld planted(scene, progress);
  BuiltScene built;
  built.camera = planted.camera(settings, progress);
  PlantedWorld::Parts parts =
      std::move(planted).parts_for(built.camera, scene.render.size, progress);
  built.world = std::move(parts.world);
  built.models = std::move(parts.trees);
  built.maps = std::move(parts.maps);
  built.seconds = std::move(parts.seconds);
  built.plants = std::move(parts.plants);
  const auto began = std::chrono::steady_clock::now();
  built.rays = trace_scene(*built.world, *built.models, built.camera, scene.render,
                           scene.render.size, progress);
  built.seconds["ray tracer"] +=
      std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  return built;
}

}  // namespace wold
