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
#include "cli/delivery.hpp"
#include "cli/picture_options.hpp"
#include "cli/session.hpp"
#include "image/atomic_file.hpp"
#include "image/io.hpp"
#include "image/tonemap.hpp"
#include "scene/build.hpp"

namespace wold {

namespace {

using Clock = std::chrono::steady_clock;

struct RenderOptions {
  std::string scene;
  std::vector<std::string> outputs;
  std::string size;
  std::string samples;
  std::string camera;
};

double since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// "N" is [0, N); "A:B" is [A, B).
SampleRange parse_samples(const std::string& text) {
  const auto colon = text.find(':');
  const auto first = colon == std::string::npos ? 0U : whole_number(text.substr(0, colon));
  const auto last = whole_number(colon == std::string::npos ? text : text.substr(colon + 1));
  if (!first || !last || *first >= *last || *last > (1U << 20U))
    throw Error(ErrorKind::usage,
                fmt::format("'--samples {}' must be a number such as 64, or a range such as 0:32 "
                            "with the end after the start, up to {}",
                            text, 1U << 20U));
  return {*first, *last};
}

/// One render, from the command line to its files.
class RenderRun {
 public:
  RenderRun(const Session& session, RenderOptions options)
      : session_(session), options_(std::move(options)) {}

  void run() {
    const auto start = Clock::now();
    prepare();
    Progress progress = session_.progress();
    BuiltScene built = build(scene_, options_.camera, progress);
    const double build_seconds = since(start);
    describe_scene(built);
    const CameraRays camera(built.camera, film_.width(), film_.height());
    const auto render_start = Clock::now();
    RenderCounts counts;
    bool interrupted = false;
    try {
      counts = trace_picture(*built.rays, camera, scene_.render,
                             {range_, scene_.header.seed, false}, film_, progress);
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::cancelled || film_.total_samples() == 0) throw;
      progress.end();
      interrupted = true;
    }
    const double render_seconds = since(render_start);
    complete_ = !interrupted;
    write();
    report(built, counts, build_seconds, render_seconds, interrupted);
    delivery_.check();
    if (interrupted)
      throw Error(
          ErrorKind::cancelled,
          fmt::format("interrupted; the picture so far, {:.1f} samples for each pixel, is in {}",
                      mean_samples(), fmt::join(options_.outputs, " and ")));
  }

 private:
  /// Everything that can be wrong is found here, before any work.
  void prepare() {
    std::vector<std::string> overrides = session_.overrides();
    if (!options_.size.empty()) overrides.push_back(size_override(options_.size));
    if (!options_.samples.empty()) range_ = parse_samples(options_.samples);
    if (options_.outputs.empty())
      options_.outputs.push_back(std::filesystem::path(options_.scene).stem().string() + ".png");
    for (const std::string& output : options_.outputs) {
      static const std::vector<std::string> known{".exr", ".png"};
      check_writable(output, known);
    }
    scene_ = read_scene(options_.scene, overrides);
    if (options_.samples.empty()) range_ = {0, static_cast<std::uint32_t>(scene_.render.samples)};
    (void)scene_.camera(options_.camera);
    check_scene(scene_);
    try {
      film_ = Film(scene_.render.size.x, scene_.render.size.y);
    } catch (const Error& error) {
      if (!options_.size.empty()) throw;
      throw error.at(scene_.location("render.size"));
    }
  }

  void describe_scene(const BuiltScene& built) const {
    std::string plants;
    for (const auto& [name, count] : built.plants)
      plants += fmt::format("{}{} {}", plants.empty() ? "" : ", ",
                            count_text(static_cast<double>(count)), name);
    const Vec3 p = built.camera.position;
    session_.say(fmt::format("{} triangles ({} with every plant counted); plants: {}",
                             count_text(static_cast<double>(built.rays->unique_triangles())),
                             count_text(static_cast<double>(built.rays->all_triangles())),
                             plants.empty() ? "none" : plants));
    const Vec3 d = built.camera.direction;
    session_.say(
        fmt::format("[camera]\nposition = [{:.1f}, {:.1f}, {:.1f}]\n"
                    "look_direction = [{:.3f}, {:.3f}, {:.3f}]",
                    p.x, p.y, p.z, d.x, d.y, d.z));
  }

  double mean_samples() const {
    return static_cast<double>(film_.total_samples()) /
           (static_cast<double>(film_.width()) * film_.height());
  }

  void write_one(const std::string& path, const Image& image) const {
    if (extension_of(path) == ".png") {
      write_png(path, display_image(image, scene_.picture, land_weights(image)),
                {.bits = 8, .srgb = true, .dither = true});
      return;
    }
    ExrOptions exr;
    exr.half_channels = {"albedo.R", "albedo.G", "albedo.B", "normal.X", "normal.Y", "normal.Z"};
    exr.metadata = {{"wold.version", WOLD_VERSION},
                    {"wold.scene", std::filesystem::path(options_.scene).filename().string()},
                    {"wold.seed", std::to_string(scene_.header.seed)},
                    {"wold.samples", fmt::format("{}:{}", range_.first, range_.last)},
                    {"wold.complete", complete_ ? "true" : "false"},
                    {"wold.whiteLuminance", fmt::format("{}", white_luminance)}};
    write_exr(path, image, exr);
  }

  void write() {
    const Image image = film_.image();
    std::vector<std::string> written;
    for (const std::string& output : options_.outputs) {
      const std::string path =
          delivery_.write(output, [&](const std::string& p) { write_one(p, image); });
      if (!path.empty()) written.push_back(path);
    }
    options_.outputs = written;
  }

  void report(const BuiltScene& built, const RenderCounts& counts, double build_seconds,
              double render_seconds, bool interrupted) const {
    if (film_.rejected() > 0)
      session_.say(fmt::format("wold: warning: {} samples were not finite and were left out",
                               film_.rejected()));
    if (!interrupted && delivery_.complete())
      session_.say(fmt::format("wrote {} ({} x {}, {} samples, scene {}, rendering {})",
                               fmt::join(options_.outputs, " and "), film_.width(), film_.height(),
                               range_.last - range_.first, duration_text(build_seconds),
                               duration_text(render_seconds)));
    Json seconds;
    for (const auto& [stage, time] : built.seconds) seconds[stage] = time;
    seconds["scene"] = build_seconds;
    seconds["render"] = render_seconds;
    seconds["first_pass"] = counts.first_pass_seconds;
    const Camera& c = built.camera;
    session_.print({{"command", "render"},
                    {"scene", options_.scene},
                    {"outputs", options_.outputs},
                    {"complete", !interrupted},
                    {"size", {film_.width(), film_.height()}},
                    {"samples", {range_.first, range_.last}},
                    {"seed", scene_.header.seed},
                    {"camera",
                     {{"position", {c.position.x, c.position.y, c.position.z}},
                      {"look_direction", {c.direction.x, c.direction.y, c.direction.z}},
                      {"field_of_view", c.field_of_view}}},
                    {"seconds", seconds},
                    {"paths", film_.total_samples() + film_.rejected()},
                    {"rays", counts.rays},
                    {"paths_per_second",
                     static_cast<double>(film_.total_samples()) / std::max(render_seconds, 1e-9)},
                    {"rejected_samples", film_.rejected()},
                    {"instances", built.world->instances.size()},
                    {"plants", built.plants},
                    {"unique_triangles", built.rays->unique_triangles()},
                    {"triangles", built.rays->all_triangles()},
                    {"peak_memory_bytes", peak_memory()}});
  }

  const Session& session_;
  RenderOptions options_;
  Scene scene_;
  SampleRange range_;
  Film film_;
  bool complete_ = false;  ///< every sample of the range was traced
  Delivery delivery_;
};

}  // namespace

void add_render(CLI::App& app, Session& session) {
  auto options = std::make_shared<RenderOptions>();
  CLI::App* command = app.add_subcommand("render", "Make a scene's picture");
  command->add_option("scene", options->scene, "The scene's TOML file")
      ->required()
      ->type_name("SCENE");
  command
      ->add_option(
          "-o,--output", options->outputs,
          "Picture to write, .png or .exr (linear, with layers); may be given more than once")
      ->type_name("FILE")
      ->allow_extra_args(false);
  command->add_option("--size", options->size, "Size of the picture in pixels")->type_name("WxH");
  command
      ->add_option("--samples", options->samples, "Light paths for each pixel, or a range of them")
      ->type_name("N|A:B");
  command->add_option("--camera", options->camera, "Which of the scene's cameras")
      ->type_name("NAME");
  session.add_scene_options(*command);
  session.add_output_options(*command);
  command->callback([&session, options] {
    std::optional<ThreadLimit> limit;
    if (session.threads > 0) limit.emplace(session.threads);
    RenderRun(session, *options).run();
  });
}

}  // namespace wold
