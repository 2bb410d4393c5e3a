#include "scene/scene_maps.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "terrain/import.hpp"

namespace wold {

void check_map(const Scene& scene, const std::string& name, const char* what,
               const OperatorList& operators) {
  if (name.empty()) return;
  std::vector<std::string> known;
  for (const TerrainStep& step : scene.steps) {
    if (!step.settings.enabled) continue;
    for (const std::string& map : find_operator(operators, step.op, step.location).maps) {
      known.push_back(map);
      if (!step.settings.name.empty())
        known.push_back(map == "mask" ? step.settings.name : step.settings.name + "." + map);
    }
  }
  if (std::find(known.begin(), known.end(), name) != known.end()) return;
  const std::string extension = std::filesystem::path(name).extension().string();
  if (std::find(picture_extensions().begin(), picture_extensions().end(), extension) !=
          picture_extensions().end() ||
      extension == ".jpg" || extension == ".jpeg") {
    find_scene_file(name, scene.folder);
    return;
  }
  throw Error(ErrorKind::input,
              fmt::format("{} '{}' is neither a map of the terrain's steps nor a picture.{}", what,
                          name, suggestion(name, known)));
}

Heightfield scene_map(const Scene& scene, const std::string& name, const Heightfield& field,
                      const std::map<std::string, Grid<float>>& maps, const TerrainDomain& place,
                      Progress& progress) {
  if (name.empty()) return {};
  Heightfield map{{}, field.origin, field.cell};
  if (const auto made = maps.find(name); made != maps.end())
    map.height = made->second;
  else
    map.height = picture_over(find_scene_file(name, scene.folder), "", place, field, progress);
  return map;
}

}  // namespace wold
