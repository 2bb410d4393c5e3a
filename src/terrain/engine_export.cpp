#include "terrain/engine_export.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "image/atomic_file.hpp"

namespace wold {

namespace {

using Settings = std::vector<std::pair<std::string, std::string>>;

std::vector<int> powers_of_two_plus_one() {
  std::vector<int> sizes;
  for (int n = 5; n <= 13; ++n) sizes.push_back((1 << n) + 1);
  return sizes;
}

std::string number(double value) {
  std::string text = fmt::format("{:.4f}", value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.ends_with('.')) text.pop_back();
  return text == "-0" ? "0" : text;
}

Settings unreal_settings(const Heightfield& field, const ExportReport& report) {
  const double extent = static_cast<double>(report.range.high) - report.range.low;
  const double cm_per_m = 100;
  const double middle = report.range.low + extent * 32768 / 65535;
  const DVec2 center = field.origin + 0.5 * field.size();
  return {{"Location X (cm)", number(cm_per_m * (center.x - 0.5 * field.size().x))},
          {"Location Y (cm)", number(-cm_per_m * (center.y + 0.5 * field.size().y))},
          {"Location Z (cm)", number(cm_per_m * middle)},
          {"Scale X", number(cm_per_m * field.cell)},
          {"Scale Y", number(cm_per_m * field.cell)},
          {"Scale Z", number(cm_per_m * extent * 128 / 65535)}};
}

Settings unity_settings(const Heightfield& field, const ExportReport& report) {
  const double extent = static_cast<double>(report.range.high) - report.range.low;
  return {{"Depth", "Bit 16"},
          {"Resolution", fmt::format("{}", report.width)},
          {"Byte Order", "Windows"},
          {"Flip Vertically", "off"},
          {"Terrain Size X (m)", number(field.size().x)},
          {"Terrain Size Y (m)", number(extent)},
          {"Terrain Size Z (m)", number(field.size().y)},
          {"Position Y (m)", number(report.range.low)}};
}

Settings godot_settings(const Heightfield& field, const ExportReport& report) {
  Settings settings{{"Vertex spacing (m)", number(field.cell)}};
  if (report.precision > 0) {
    settings.emplace_back("R16 range low (m)", number(report.range.low));
    settings.emplace_back("R16 range high (m)", number(report.range.high));
    settings.emplace_back("R16 size", fmt::format("{} x {}", report.width, report.height));
  } else {
    settings.emplace_back("Import scale", "1");
    settings.emplace_back("Height offset", "0");
  }
  return settings;
}

}  // namespace

std::vector<EnginePreset> engine_presets() {
  return {{"unreal",
           "Unreal Engine: a landscape's height map.",
           {127, 253, 505, 1009, 2017, 4033, 8129},
           {".png", ".r16"},
           false},
          {"unity", "Unity: a terrain's raw height map.", powers_of_two_plus_one(), {".raw"}, true},
          {"godot",
           "Godot: a height map for its terrain add-ons.",
           powers_of_two_plus_one(),
           {".exr", ".r16"},
           false}};
}

EnginePreset find_engine(std::string_view name) {
  std::vector<std::string> names;
  for (const EnginePreset& preset : engine_presets()) {
    if (preset.name == name) return preset;
    names.push_back(preset.name);
  }
  throw Error(ErrorKind::usage,
              fmt::format("unknown engine '{}'.{}", name, suggestion(name, names)));
}

int engine_size(const EnginePreset& preset, int wanted) {
  return *std::min_element(preset.sizes.begin(), preset.sizes.end(), [&](int a, int b) {
    return std::abs(a - wanted) < std::abs(b - wanted);
  });
}

void check_engine_export(const EnginePreset& preset, const std::string& path, int width,
                         int height) {
  const auto& extensions = preset.extensions;
  if (std::find(extensions.begin(), extensions.end(), extension_of(path)) == extensions.end())
    throw Error(ErrorKind::usage, fmt::format("{} takes {} files, not '{}'", preset.name,
                                              fmt::join(extensions, " or "), path));
  for (const int size : {width, height})
    if (std::find(preset.sizes.begin(), preset.sizes.end(), size) == preset.sizes.end())
      throw Error(ErrorKind::usage,
                  fmt::format("{} does not take {} x {} samples; sides can be {}", preset.name,
                              width, height, fmt::join(preset.sizes, ", ")));
  if (preset.square && width != height)
    throw Error(ErrorKind::usage, fmt::format("{} takes square height maps only, not {} x {}",
                                              preset.name, width, height));
}

ExportReport export_for_engine(const Heightfield& field, const std::string& path,
                               const EnginePreset& preset) {
  check_engine_export(preset, path, field.height.width(), field.height.height());
  ExportOptions options;
  options.flip = preset.name == "unity";
  ExportReport report = export_heightfield(field, path, options);
  if (preset.name == "unreal") report.settings = unreal_settings(field, report);
  if (preset.name == "unity") report.settings = unity_settings(field, report);
  if (preset.name == "godot") report.settings = godot_settings(field, report);
  return report;
}

}  // namespace wold
