#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "cli/commands.hpp"
#include "cli/height_input.hpp"
#include "cli/outputs.hpp"
#include "cli/session.hpp"
#include "scene/scene.hpp"
#include "terrain/analysis.hpp"
#include "terrain/export.hpp"

namespace wold {

namespace {

struct ErodeOptions {
  std::string input;
  std::vector<std::string> outputs;
  std::vector<std::string> operators;
  std::string steps;
  std::string mask;
  std::string maps;
  bool map_pictures = false;
  std::string preview;
  double cell = 0;
  HeightInputOptions height;
};

/// A scene of nothing but the steps that --op names.
std::string steps_text(const std::vector<std::string>& operators) {
  std::string text;
  for (const std::string& op : operators) text += fmt::format("[[terrain.step]]\nop = '{}'\n", op);
  return text;
}

/// Settings of a step as the scene's reader takes them: `rain=2` of the only operator,
/// `droplets.rain=2` of one by name, `1.rain=2` by place.
std::string override_of(const std::string& setting, std::size_t count) {
  const std::size_t sign = setting.find('=');
  const bool names_step = setting.find('.') < sign;
  if (names_step) return "terrain.step." + setting;
  if (count == 1) return "terrain.step.0." + setting;
  throw Error(ErrorKind::usage,
              fmt::format("'--set {0}' does not say of which operator; with several, write "
                          "OPERATOR.{0}",
                          setting));
}

class ErodeRun {
 public:
  ErodeRun(const Session& session, ErodeOptions options)
      : session_(session), options_(std::move(options)) {}

  void run() {
    prepare();
    const HeightInput input = read_height_input(options_.input, options_.height, session_);
    Progress progress = session_.progress();
    const auto start = std::chrono::steady_clock::now();
    const TerrainResult result = evaluate_on(input.field, scene_.steps, scene_operators(),
                                             scene_.header.seed, scene_.folder, progress);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    write(result, input, seconds.count());
  }

 private:
  void prepare() {
    if (options_.operators.empty() == options_.steps.empty())
      throw Error(ErrorKind::usage,
                  "say what to do: --op NAME (once or more, in order), or --steps SCENE.toml");
    scene_ = options_.steps.empty() ? scene_of_operators()
                                    : read_scene(options_.steps, session_.overrides());
    for (TerrainStep& step : scene_.steps) {
      if (!options_.mask.empty()) step.settings.mask = options_.mask;
      if (options_.cell > 0) step.settings.cell = options_.cell;
    }
    if (options_.outputs.empty())
      throw Error(ErrorKind::usage, "say where the result goes, as with -o eroded.exr");
    for (const std::string& output : options_.outputs) check_export(output);
    check_map_folder(options_.maps);
    check_preview(options_.preview);
  }

  Scene scene_of_operators() const {
    const OperatorList known = scene_operators();
    for (const std::string& op : options_.operators) find_operator(known, op);
    std::vector<std::string> overrides;
    for (const std::string& setting : session_.overrides())
      overrides.push_back(
          setting.starts_with("seed=") ? setting : override_of(setting, options_.operators.size()));
    Scene scene = parse_scene(steps_text(options_.operators), "--op", {}, overrides);
    for (TerrainStep& step : scene.steps) step.location = {};
    return scene;
  }

  void write(const TerrainResult& result, const HeightInput& before, double seconds) const {
    const std::optional<Range> range = range_for(result.field, before.range);
    std::vector<ExportReport> reports;
    for (const std::string& output : options_.outputs) {
      reports.push_back(export_heightfield(result.field, output, {.range = range}));
      session_.say(told(reports.back()));
    }
    std::vector<std::string> maps;
    if (!options_.maps.empty())
      maps = export_maps(all_maps(result), options_.maps, options_.map_pictures);
    if (!maps.empty()) session_.say(fmt::format("wrote {}", fmt::join(maps, ", ")));
    if (!options_.preview.empty()) write_preview(options_.preview, result.field);
    tell_balances(result.balances);
    report(result, before.field, reports, maps, seconds);
  }

  /// Integers keep the meaning that they had in the input, if all heights still fit.
  static std::optional<Range> range_for(const Heightfield& field,
                                        const std::optional<Range>& before) {
    const HeightStatistics heights = height_statistics(field);
    const bool fits = before && before->contains(heights.min) && before->contains(heights.max);
    return fits ? before : std::nullopt;
  }

  void tell_balances(const std::vector<Balance>& balances) const {
    for (const Balance& b : balances) {
      if (b.moved <= 0) continue;
      std::string line =
          fmt::format("{}: {} m³ of {} moved", b.step, count_text(b.moved), b.quantity);
      if (b.added > 0) line += fmt::format(", {} m³ came in", count_text(b.added));
      if (b.removed > 0) line += fmt::format(", {} m³ left", count_text(b.removed));
      session_.say(line);
    }
  }

  void report(const TerrainResult& result, const Heightfield& before,
              const std::vector<ExportReport>& reports, const std::vector<std::string>& maps,
              double seconds) const {
    const auto heights = [](const Heightfield& field) {
      const HeightStatistics s = height_statistics(field);
      return Json{{"min", s.min}, {"max", s.max}, {"mean", s.mean}};
    };
    Json files = Json::array();
    for (const ExportReport& r : reports) files.push_back(json_of(r));
    Json steps = Json::array();
    for (const TerrainStep& step : scene_.steps) steps.push_back(step.op);
    const auto samples = static_cast<double>(result.field.height.size());
    session_.print({{"command", "erode"},
                    {"input", options_.input},
                    {"steps", steps},
                    {"seed", scene_.header.seed},
                    {"files", files},
                    {"maps", maps},
                    {"size_metres", {result.field.size().x, result.field.size().y}},
                    {"cell", result.field.cell},
                    {"heights_before", heights(before)},
                    {"heights", heights(result.field)},
                    {"balances", json_of(result.balances)},
                    {"seconds", seconds},
                    {"samples_per_second", samples / std::max(seconds, 1e-9)},
                    {"peak_memory_bytes", peak_memory()}});
  }

  const Session& session_;
  ErodeOptions options_;
  Scene scene_;
};

}  // namespace

void add_erode(CLI::App& app, Session& session) {
  auto options = std::make_shared<ErodeOptions>();
  CLI::App* command = app.add_subcommand("erode", "Erode a height map of your own");
  command
      ->add_option("height", options->input,
                   "The height map: .exr .tif .png .r16, or elevation data (GeoTIFF, .hgt)")
      ->required()
      ->type_name("HEIGHT");
  command
      ->add_option("-o,--output", options->outputs,
                   "File to write: .exr .tif (metres), .png .r16 .raw (16 bits), .obj .ply .glb "
                   "(mesh); may be given more than once")
      ->type_name("FILE")
      ->allow_extra_args(false);
  command
      ->add_option("--op", options->operators,
                   "What to do ('wold help' lists the operators); several are done in order")
      ->type_name("NAME")
      ->allow_extra_args(false);
  command->add_option("--steps", options->steps, "Do the [[terrain.step]]s of a scene file instead")
      ->type_name("SCENE");
  options->height.add_to(*command);
  command
      ->add_option("--mask", options->mask, "Picture over the map: where it is white, all is done")
      ->type_name("FILE");
  command
      ->add_option("--cell", options->cell,
                   "Work on samples this far apart and add the change to the map: faster, and fine "
                   "detail stays")
      ->check(CLI::PositiveNumber)
      ->type_name("METRES");
  command
      ->add_option("--maps", options->maps,
                   "Folder for maps: those of the operators, slope and curvature")
      ->type_name("FOLDER");
  command->add_flag("--map-pictures", options->map_pictures,
                    "Write each map also as a picture from black to white (.png)");
  command
      ->add_option("--preview", options->preview, "Write the land in slanting light as a picture")
      ->type_name("FILE");
  command->add_option("--seed", session.seed, "Another number gives other random numbers")
      ->type_name("N");
  command
      ->add_option("--set", session.settings,
                   "Set a parameter, such as rain=2, or droplets.rain=2 with several operators")
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false);
  session.add_output_options(*command);
  command->callback([&session, options] {
    std::optional<ThreadLimit> limit;
    if (session.threads > 0) limit.emplace(session.threads);
    ErodeRun(session, *options).run();
  });
}

}  // namespace wold
