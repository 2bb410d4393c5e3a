#include "plants/plant.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace wold {

const PlantMaterial* Plant::find_material(std::string_view material) const {
  const auto found = std::find_if(materials.begin(), materials.end(),
                                  [&](const PlantMaterial& m) { return m.name == material; });
  return found == materials.end() ? nullptr : &*found;
}

Description<GrowSettings> describe(const GrowSettings&) {
  return Description<GrowSettings>("grow", "One model of a plant.")
      .add("seed", &GrowSettings::seed, "Which individual.")
      .add("height", &GrowSettings::height, {.unit = "m", .min = 0, .max = 1e6},
           "Height of the model; 0: the file's own.")
      .add("iterations", &GrowSettings::iterations, {.min = 0, .max = 10000},
           "Derivation steps; 0: the file's own.")
      .add("detail", &GrowSettings::detail, {.min = 0.01, .max = 8},
           "Below 1 fewer sides and fewer, larger leaves; above 1 rounder branches.")
      .add("max_modules", &GrowSettings::max_modules, {.min = 1, .max = 400e6},
           "A word longer than this is refused.");
}

Plant load_plant(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream text;
  if (!stream || !(text << stream.rdbuf()))
    throw Error(ErrorKind::io,
                fmt::format("cannot read the plant file '{}': {}", path, std::strerror(errno)));
  Plant plant = parse_plant(text.str(), path);
  plant.name = std::filesystem::path(path).stem().string();
  return plant;
}

Word derive(const Plant& plant, const GrowSettings& settings, Progress& progress) {
  const int iterations = settings.iterations > 0 ? settings.iterations : plant.iterations;
  return derive(plant.system, iterations, settings.seed, {settings.max_modules}, progress);
}

TriangleMesh grow(const Plant& plant, const GrowSettings& settings, Progress& progress) {
  const Word word = derive(plant, settings, progress);
  BuildSettings build;
  build.foot_radius = plant.turtle.radius;
  build.height = settings.height > 0 ? settings.height : plant.height;
  build.detail = settings.detail;
  build.seed = settings.seed;
  return build_mesh(draw(word, plant.turtle), plant.geometry, plant.organs, build, progress);
}

}  // namespace wold
