#include "cli/outputs.hpp"

#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "image/atomic_file.hpp"
#include "image/io.hpp"
#include "terrain/analysis.hpp"

namespace wold {

namespace {

std::map<std::string, Grid<float>> all_maps(const TerrainResult& terrain) {
  std::map<std::string, Grid<float>> maps = terrain.maps;
  maps.emplace("slope", slope_map(terrain.field));
  maps.emplace("curvature", curvature_map(terrain.field));
  return maps;
}

void write_preview(const std::string& path, const Heightfield& field) {
  write_png(path, image_of(hillshade(field)), {.bits = 8});
}

}  // namespace

void SideOutputs::add_to(CLI::App& command) {
  command.add_option("--maps", maps, "Folder for maps: slope, curvature, and those of the steps")
      ->type_name("FOLDER");
  command.add_flag("--map-pictures", map_pictures,
                   "Write each map also as a picture from black to white (.png)");
  command.add_option("--preview", preview, "Write the land in slanting light as a picture")
      ->type_name("FILE");
}

void SideOutputs::check() const {
  static const std::vector<std::string> pictures{".png"};
  if (!maps.empty()) check_folder_writable(maps);
  if (!preview.empty()) check_writable(preview, pictures);
}

std::vector<std::string> SideOutputs::write(const TerrainResult& terrain, Delivery& delivery,
                                            const Session& session) const {
  std::vector<std::string> paths;
  if (!maps.empty())
    delivery.write(maps, [&](const std::string& folder) {
      paths = export_maps(all_maps(terrain), folder, map_pictures);
    });
  if (!paths.empty()) session.say(fmt::format("wrote {}", fmt::join(paths, ", ")));
  if (!preview.empty())
    delivery.write(preview, [&](const std::string& path) { write_preview(path, terrain.field); });
  return paths;
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
