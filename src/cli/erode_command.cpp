#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "cli/commands.hpp"
#include "cli/height_input.hpp"
#include "cli/outputs.hpp"
#include "cli/session.hpp"
#include "image/atomic_file.hpp"
#include "mesh/editable.hpp"
#include "mesh/io.hpp"
#include "scene/scene.hpp"
#include "terrain/analysis.hpp"
#include "terrain/export.hpp"
#include "terrain/mesh_field.hpp"

namespace wold {

namespace {

struct ErodeOptions {
  std::string input;
  std::vector<std::string> outputs;
  std::vector<std::string> operators;
  std::string steps;
  std::string mask;
  SideOutputs side;
  double cell = 0;
  std::string up = "z";
  ProjectionSettings projection;
  HeightInputOptions height;
};

/// What is eroded: ground from a height map, or a mesh seen from above.
struct Subject {
  Heightfield field;
  std::optional<Range> range;  ///< m, of the integers of a picture
  std::optional<EditableMesh> mesh;
  std::optional<MeshProjection> projection;
};

bool is_mesh(const std::string& path) {
  const std::string extension = extension_of(path);
  return extension == ".gltf" || std::find(mesh_extensions().begin(), mesh_extensions().end(),
                                           extension) != mesh_extensions().end();
}

/// Metres of a unit of the mesh, so that it is `size` metres wide.
double mesh_scale(const EditableMesh& mesh, const std::string& size) {
  if (size.empty()) return 1;
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const DVec3& p : mesh.positions()) {
    low = std::min(low, p.x);
    high = std::max(high, p.x);
  }
  return high > low ? width_of(size) / (high - low) : 1;
}

Subject read_mesh_subject(const ErodeOptions& options, const Session& session) {
  Subject subject;
  subject.mesh = EditableMesh::read(options.input, options.up == "y" ? UpAxis::y : UpAxis::z);
  ProjectionSettings settings = options.projection;
  settings.scale = mesh_scale(*subject.mesh, options.height.size);
  Progress progress = session.progress();
  subject.projection.emplace(subject.mesh->positions(), subject.mesh->triangles(), settings,
                             progress);
  subject.field = subject.projection->field();
  session.say(fmt::format("{}: {} vertices, projected onto {} x {} samples, {:.4g} m apart",
                          options.input, subject.mesh->positions().size(),
                          subject.field.height.width(), subject.field.height.height(),
                          subject.field.cell));
  return subject;
}

Subject read_subject(const ErodeOptions& options, const Session& session) {
  if (is_mesh(options.input)) return read_mesh_subject(options, session);
  HeightInput input = read_height_input(options.input, options.height, session);
  return {std::move(input.field), input.range, std::nullopt, std::nullopt};
}

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

/// The same error, that speaks of the settings as the user wrote them.
Error with_settings(const Error& error, const std::vector<std::string>& overrides,
                    const std::vector<std::string>& settings) {
  std::string message = error.message();
  SourceLocation where = error.location();
  for (std::size_t k = 0; k < settings.size(); ++k)
    for (std::string* text : {&message, &where.file})
      if (const auto at = text->find(overrides[k]); at != std::string::npos)
        text->replace(at, overrides[k].size(), settings[k]);
  return {error.kind(), message, where};
}

class ErodeRun {
 public:
  ErodeRun(const Session& session, ErodeOptions options)
      : session_(session), options_(std::move(options)) {}

  void run() {
    prepare();
    const Subject input = read_subject(options_, session_);
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
    for (const std::string& output : options_.outputs) check_output(output);
    options_.side.check();
  }

  void check_output(const std::string& output) const {
    if (is_mesh(options_.input) && is_mesh(output))
      check_editable_writable(options_.input, output);
    else
      check_export(output);
  }

  Scene scene_of_operators() const {
    const OperatorList known = scene_operators();
    for (const std::string& op : options_.operators) find_operator(known, op);
    const std::vector<std::string> settings = session_.overrides();
    std::vector<std::string> overrides;
    for (const std::string& setting : settings)
      overrides.push_back(
          setting.starts_with("seed=") ? setting : override_of(setting, options_.operators.size()));
    try {
      Scene scene = parse_scene(steps_text(options_.operators), "--op", {}, overrides);
      for (TerrainStep& step : scene.steps) step.location = {};
      return scene;
    } catch (const Error& error) {
      throw with_settings(error, overrides, settings);
    }
  }

  void write(const TerrainResult& result, const Subject& before, double seconds) const {
    const std::optional<Range> range = range_for(result.field, before.range);
    Delivery delivery;
    std::vector<ExportReport> reports;
    Json meshes = Json::array();
    for (const std::string& output : options_.outputs)
      delivery.write(output, [&](const std::string& path) {
        if (before.mesh && is_mesh(path)) {
          meshes.push_back(write_moved(before, result.field, path));
          return;
        }
        reports.push_back(export_heightfield(result.field, path, {.range = range}));
        session_.say(told(reports.back()));
      });
    const std::vector<std::string> maps = options_.side.write(result, delivery, session_);
    tell_balances(result.balances);
    report(result, before.field, reports, meshes, maps, seconds);
    delivery.check();
  }

  /// The mesh with its vertices moved as the ground beneath them was.
  Json write_moved(const Subject& subject, const Heightfield& after,
                   const std::string& output) const {
    EditableMesh mesh = *subject.mesh;
    const std::size_t moved = subject.projection->displace(mesh.positions(), after);
    mesh.write(output);
    session_.say(fmt::format("wrote {}: {} of {} vertices lie on the surface and moved with it",
                             output, moved, mesh.positions().size()));
    return {{"path", output}, {"vertices", mesh.positions().size()}, {"on_surface", moved}};
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
              const std::vector<ExportReport>& reports, const Json& meshes,
              const std::vector<std::string>& maps, double seconds) const {
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
                    {"meshes", meshes},
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
  CLI::App* command = app.add_subcommand("erode", "Erode a height map or a mesh of your own");
  command
      ->add_option(
          "height", options->input,
          "The height map: .exr .tif .png .r16, elevation data (GeoTIFF, .hgt), or a mesh: "
          ".obj .ply .glb .gltf")
      ->required()
      ->type_name("HEIGHT");
  command
      ->add_option("-o,--output", options->outputs,
                   "File to write: .exr .tif (metres), .png .r16 .raw (16 bits), .obj .ply .glb "
                   "(mesh; of a mesh the same one with its vertices moved); may be given more than "
                   "once")
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
  command->add_option("--up", options->up, "The upward axis of an OBJ or PLY mesh; glTF is Y up")
      ->check(CLI::IsMember({"y", "z"}))
      ->type_name("AXIS");
  command
      ->add_option("--resolution", options->projection.resolution,
                   "Samples along the longer side that a mesh is projected onto; default: as it "
                   "has vertices")
      ->check(CLI::Range(2, 65537))
      ->type_name("N");
  command
      ->add_option("--mask", options->mask, "Picture over the map: where it is white, all is done")
      ->type_name("FILE");
  command
      ->add_option("--cell", options->cell,
                   "Work on samples this far apart and add the change to the map: faster, and fine "
                   "detail stays")
      ->check(CLI::PositiveNumber)
      ->type_name("METRES");
  options->side.add_to(*command);
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
