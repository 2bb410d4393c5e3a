#include "cli/outputs.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "base/error.hpp"
#include "image/atomic_file.hpp"
#include "image/io.hpp"
#include "terrain/analysis.hpp"

namespace wold {

std::map<std::string, Grid<float>> all_maps(const TerrainResult& terrain) {
  std::map<std::string, Grid<float>> maps = terrain.maps;
  maps.emplace("slope", slope_map(terrain.field));
  maps.emplace("curvature", curvature_map(terrain.field));
  return maps;
}

void check_map_folder(const std::string& folder) {
  if (folder.empty()) return;
  std::error_code ignored;
  if (std::filesystem::is_directory(folder, ignored)) {
    check_writable(folder + "/slope.exr");
    return;
  }
  if (std::filesystem::exists(folder, ignored))
    throw Error(ErrorKind::io, fmt::format("cannot write maps into '{}': it is no folder", folder));
}

void check_preview(const std::string& path) {
  static const std::vector<std::string> extensions{".png"};
  if (!path.empty()) check_writable(path, extensions);
}

void write_preview(const std::string& path, const Heightfield& field) {
  write_png(path, image_of(hillshade(field)), {.bits = 8});
}

Json json_of(const ExportReport& r) {
  Json settings = Json::object();
  for (const auto& [name, value] : r.settings) settings[name] = value;
  return {{"path", r.path},
          {"format", r.format},
          {"size", {r.width, r.height}},
          {"cell", r.cell},
          {"range", {r.range.low, r.range.high}},
          {"precision", r.precision},
          {"settings", settings}};
}

Json json_of(const std::vector<Balance>& balances) {
  Json list = Json::array();
  for (const Balance& b : balances)
    list.push_back({{"step", b.step},
                    {"quantity", b.quantity},
                    {"unit", "m³"},
                    {"before", b.before},
                    {"added", b.added},
                    {"removed", b.removed},
                    {"after", b.after},
                    {"moved", b.moved},
                    {"relative_error", b.relative_error()}});
  return list;
}

std::string told(const ExportReport& r) {
  return fmt::format("wrote {}: {}, {} x {} samples, {:.4g} m apart, heights {:.2f} to {:.2f} m",
                     r.path, r.format, r.width, r.height, r.cell, r.range.low, r.range.high);
}

}  // namespace wold
