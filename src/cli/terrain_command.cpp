#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "cli/commands.hpp"
#include "cli/outputs.hpp"
#include "cli/session.hpp"
#include "scene/build.hpp"
#include "terrain/analysis.hpp"
#include "terrain/engine_export.hpp"
#include "terrain/export.hpp"

namespace wold {

namespace {

struct TerrainOptions {
  std::string scene;
  std::vector<std::string> outputs;
  int resolution = 0;
  std::string preset;
  SideOutputs side;
};

class TerrainRun {
 public:
  TerrainRun(const Session& session, TerrainOptions options)
      : session_(session), options_(std::move(options)) {}

  void run() {
    prepare();
    Progress progress = session_.progress();
    const auto start = std::chrono::steady_clock::now();
    const TerrainResult terrain = build_terrain(scene_, progress);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    Delivery delivery;
    std::vector<ExportReport> reports;
    for (const std::string& output : options_.outputs)
      delivery.write(output, [&](const std::string& path) {
        reports.push_back(preset_ ? export_for_engine(terrain.field, path, *preset_)
                                  : export_heightfield(terrain.field, path));
        tell(reports.back());
      });
    const std::vector<std::string> maps = options_.side.write(terrain, delivery, session_);
    report(terrain, reports, maps, seconds.count());
    delivery.check();
  }

 private:
  void prepare() {
    std::vector<std::string> overrides = session_.overrides();
    if (options_.resolution > 0)
      overrides.push_back(fmt::format("terrain.resolution={}", options_.resolution));
    scene_ = read_scene(options_.scene, overrides);
    if (!options_.preset.empty()) choose_preset();
    if (options_.outputs.empty())
      options_.outputs.push_back(std::filesystem::path(options_.scene).stem().string() +
                                 (preset_ ? preset_->extensions.front() : ".exr"));
    const TerrainWindow window = window_of(scene_.terrain);
    for (const std::string& output : options_.outputs) {
      check_export(output);
      if (preset_) check_engine_export(*preset_, output, window.width, window.height);
    }
    options_.side.check();
    try {
      check_terrain(window, scene_.steps, scene_operators(), scene_.folder);
    } catch (const Error& error) {
      throw error.at(scene_.location("terrain.resolution"));
    }
  }

  /// An engine takes certain sizes only: without a word from the user, the nearest one.
  void choose_preset() {
    preset_ = find_engine(options_.preset);
    const int wanted = scene_.terrain.resolution;
    const int size = engine_size(*preset_, wanted);
    if (size == wanted) return;
    if (options_.resolution > 0)
      throw Error(ErrorKind::usage,
                  fmt::format("{} takes no height map of {} samples; it takes {}", preset_->name,
                              wanted, fmt::join(preset_->sizes, ", ")));
    session_.say(fmt::format("{} samples instead of {}, as {} wants", size, wanted, preset_->name));
    scene_.terrain.resolution = size;
  }

  void tell(const ExportReport& r) const {
    session_.say(told(r));
    for (const auto& [name, value] : r.settings) session_.say(fmt::format("  {}: {}", name, value));
  }

  void report(const TerrainResult& terrain, const std::vector<ExportReport>& reports,
              const std::vector<std::string>& maps, double seconds) const {
    const HeightStatistics heights = height_statistics(terrain.field);
    Json files = Json::array();
    for (const ExportReport& r : reports) files.push_back(json_of(r));
    const auto samples = static_cast<double>(terrain.field.height.size());
    session_.print(
        {{"command", "terrain"},
         {"scene", options_.scene},
         {"seed", scene_.header.seed},
         {"files", files},
         {"maps", maps},
         {"size_metres", {terrain.field.size().x, terrain.field.size().y}},
         {"heights", {{"min", heights.min}, {"max", heights.max}, {"mean", heights.mean}}},
         {"balances", json_of(terrain.balances)},
         {"seconds", seconds},
         {"samples_per_second", samples / std::max(seconds, 1e-9)},
         {"peak_memory_bytes", peak_memory()}});
  }

  const Session& session_;
  TerrainOptions options_;
  Scene scene_;
  std::optional<EnginePreset> preset_;
};

}  // namespace

void add_terrain(CLI::App& app, Session& session) {
  auto options = std::make_shared<TerrainOptions>();
  CLI::App* command =
      app.add_subcommand("terrain", "Make a scene's land as a height map or a mesh, and its maps");
  command->add_option("scene", options->scene, "The scene's TOML file")
      ->required()
      ->type_name("SCENE");
  command
      ->add_option("-o,--output", options->outputs,
                   "File to write: .exr .tif (metres), .png .r16 .raw (16 bits), .obj .ply .glb "
                   "(mesh); may be given more than once")
      ->type_name("FILE")
      ->allow_extra_args(false);
  command
      ->add_option("--resolution", options->resolution,
                   "Samples west to east, instead of the scene's")
      ->check(CLI::Range(2, 65537))
      ->type_name("N");
  command
      ->add_option("--preset", options->preset,
                   "Size, format and numbers for an engine: unreal, unity or godot")
      ->type_name("ENGINE");
  options->side.add_to(*command);
  session.add_scene_options(*command);
  session.add_output_options(*command);
  command->callback([&session, options] {
    std::optional<ThreadLimit> limit;
    if (session.threads > 0) limit.emplace(session.threads);
    TerrainRun(session, *options).run();
  });
}

}  // namespace wold
