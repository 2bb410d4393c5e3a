#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>

#include "base/parallel.hpp"
#include "cli/commands.hpp"
#include "cli/delivery.hpp"
#include "cli/session.hpp"
#include "gpu/context.hpp"
#include "image/atomic_file.hpp"
#include "image/io.hpp"
#include "realtime/export.hpp"
#include "realtime/landscape_picture.hpp"
#include "scene/build.hpp"

namespace wold {

namespace {

struct ShaderOptions {
  std::string scene;
  std::string target = "shadertoy";
  std::string output;
  std::vector<std::string> defines;
  std::string terrain = "auto";
  std::string camera;
  std::string screenshot;
  std::string size = "640x360";
  float time = 0;
  int samples = 4;
};

struct TargetName {
  const char* name;
  ShaderTarget target;
  const char* extension;
};
constexpr std::array target_names{TargetName{"shadertoy", ShaderTarget::shadertoy, ".glsl"},
                                  TargetName{"html", ShaderTarget::html, ".html"},
                                  TargetName{"glsl", ShaderTarget::glsl, ".frag"}};

const TargetName& target_of(const std::string& name) {
  std::vector<std::string> known;
  for (const TargetName& t : target_names) {
    if (name == t.name) return t;
    known.emplace_back(t.name);
  }
  throw Error(ErrorKind::usage, fmt::format("there is no target '{}'; there are {}.{}", name,
                                            fmt::join(known, ", "), suggestion(name, known)));
}

IVec2 size_of(const std::string& text) {
  IVec2 size(0);
  char rest = 0;
  if (std::sscanf(text.c_str(), "%dx%d%c", &size.x, &size.y, &rest) != 2 || size.x < 1 ||
      size.y < 1 || std::max(size.x, size.y) > 16384)
    throw Error(ErrorKind::usage,
                fmt::format("--size wants pixels as in 640x360, up to 16384, not '{}'", text));
  return size;
}

class ShaderRun {
 public:
  ShaderRun(const Session& session, ShaderOptions options)
      : session_(session), options_(std::move(options)), target_(target_of(options_.target)) {}

  void run() {
    const auto start = std::chrono::steady_clock::now();
    LandscapeSettings checked;
    set_knobs(checked, options_.defines);
    const IVec2 size = size_of(options_.size);
    const Scene scene = read_scene(options_.scene, session_.overrides());
    Progress progress = session_.progress();
    Landscape landscape = landscape_of(scene, landscape_options(scene), progress);
    set_knobs(landscape.settings, options_.defines);
    const std::string text = export_shader(landscape, target_.target);
    if (options_.output.empty())
      options_.output = std::filesystem::path(options_.scene).stem().string() + target_.extension;

    Delivery delivery;
    const std::string written =
        delivery.write(options_.output, [&](const std::string& path) { write_file(path, text); });
    tell(landscape, text, written);
    const std::string picture = screenshot(landscape, size, delivery);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    session_.print({{"command", "shader"},
                    {"scene", options_.scene},
                    {"target", target_.name},
                    {"file", written},
                    {"bytes", text.size()},
                    {"terrain", landscape.map ? "map" : "function"},
                    {"left_out", landscape.left_out},
                    {"screenshot", picture},
                    {"seconds", seconds.count()},
                    {"peak_memory_bytes", peak_memory()}});
    delivery.check();
  }

 private:
  LandscapeOptions landscape_options(const Scene& scene) const {
    LandscapeOptions out;
    out.camera = options_.camera;
    const bool html = target_.target == ShaderTarget::html;
    if (options_.terrain == "map" || (options_.terrain == "auto" && html && !is_function(scene)))
      out.source = LandSource::map;
    else if (options_.terrain != "auto" && options_.terrain != "function")
      throw Error(ErrorKind::usage,
                  fmt::format("--terrain is auto, function or map, not '{}'", options_.terrain));
    if (out.source == LandSource::map && !html)
      throw Error(ErrorKind::usage,
                  "only --target html can carry the land as a map; others want --terrain function");
    return out;
  }

  void tell(const Landscape& landscape, const std::string& text, const std::string& written) const {
    if (!landscape.left_out.empty())
      session_.say(fmt::format("left out, because they need the whole land: {}{}{}",
                               fmt::join(landscape.left_out, ", "),
                               landscape.stand_in.empty() ? "" : "; ", landscape.stand_in));
    if (!written.empty())
      session_.say(fmt::format("wrote {}: {}, {:.0f} kB", written, target_.name,
                               static_cast<double>(text.size()) / 1000));
  }

  std::string screenshot(const Landscape& landscape, IVec2 size, Delivery& delivery) const {
    if (options_.screenshot.empty()) return "";
    const OffscreenContext context;
    const LandscapeDrawing drawing(landscape_tab(landscape), landscape.map);
    const int across = static_cast<int>(std::ceil(std::sqrt(options_.samples)));
    const Image image = landscape_picture(drawing, size.x, size.y, options_.time, nullptr, across);
    std::string written = delivery.write(options_.screenshot, [&](const std::string& path) {
      write_png(path, image, {.bits = 8, .srgb = true});
    });
    if (!written.empty())
      session_.say(fmt::format("wrote {}: {} x {} pixels", written, size.x, size.y));
    return written;
  }

  const Session& session_;
  ShaderOptions options_;
  const TargetName& target_;
};

std::string knobs_text() {
  const LandscapeSettings defaults;
  return "Knobs for --define, with what they are where the scene does not say:\n" +
         help_text(describe(defaults), &defaults);
}

}  // namespace

void add_shader(CLI::App& app, Session& session) {
  auto options = std::make_shared<ShaderOptions>();
  CLI::App* command = app.add_subcommand(
      "shader", "Export a scene's landscape as a shader for Shadertoy, a web page, or GLSL");
  command->add_option("scene", options->scene, "The scene's TOML file")
      ->required()
      ->type_name("SCENE");
  command
      ->add_option("--target", options->target,
                   "shadertoy: one tab to paste; html: a page by itself; glsl: a fragment shader")
      ->type_name("TARGET");
  command->add_option("-o,--output", options->output, "File to write")->type_name("FILE");
  command
      ->add_option("--define", options->defines,
                   "Sets a knob of the shader; may be given more than once")
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false);
  command
      ->add_option("--terrain", options->terrain,
                   "How the land travels: function (of the place), map (html only), or auto: a map "
                   "where steps need the whole land and the target can carry it")
      ->type_name("HOW");
  command->add_option("--camera", options->camera, "Where the flight begins; default: the first")
      ->type_name("NAME");
  command
      ->add_option("--screenshot", options->screenshot,
                   "Also draws what was exported, as PNG; needs OpenGL, no window")
      ->type_name("FILE");
  command->add_option("--size", options->size, "Of the screenshot, pixels")->type_name("WxH");
  command
      ->add_option("--samples", options->samples,
                   "Of the screenshot, rays to each pixel, up to the next square; 1: as a page or "
                   "Shadertoy shows it")
      ->check(CLI::Range(1, 64))
      ->type_name("N");
  command->add_option("--time", options->time, "Of the screenshot, seconds into the flight")
      ->type_name("S");
  session.add_scene_options(*command);
  session.add_output_options(*command);
  command->footer([] { return knobs_text(); });
  command->callback([&session, options] {
    std::optional<ThreadLimit> limit;
    if (session.threads > 0) limit.emplace(session.threads);
    ShaderRun(session, *options).run();
  });
}

}  // namespace wold
