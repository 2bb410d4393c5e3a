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
#include "gpu/context.hpp"
#include "image/atomic_file.hpp"
#include "image/io.hpp"
#include "image/tonemap.hpp"
#include "raster/scene_drawing.hpp"
#include "scene/build.hpp"
#include "scene/planted_world.hpp"

namespace wold {

namespace {

using Clock = std::chrono::steady_clock;

struct ViewOptions {
  std::string scene;
  std::string screenshot;
  std::string size;
  std::string camera;
  std::string quality = "high";
  int samples = 32;
  int frames = 0;
};

double since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Pictures without a window.
class OffscreenRun {
 public:
  OffscreenRun(const Session& session, ViewOptions options)
      : session_(session), options_(std::move(options)) {}

  void run() {
    std::vector<std::string> overrides = session_.overrides();
    if (!options_.size.empty()) overrides.push_back(size_override(options_.size));
    if (!options_.screenshot.empty()) check_writable(options_.screenshot, known_);
    Scene scene = read_scene(options_.scene, overrides);
    const CameraSettings settings = scene.camera(options_.camera);
    check_scene(scene);
    const OffscreenContext context;
    const GpuInfo info = gpu_info();
    Progress progress = session_.progress();
    const ToneMapping tone = scene.picture;
    const IVec2 size = scene.render.size;
    PlantedWorld world(std::move(scene), progress);
    const Camera camera = world.camera(settings, progress);
    SceneDrawing drawing(world, scene_detail(quality()), progress);
    drawing.resize(size.x, size.y);
    drawing.settle(camera);
    const int frames = options_.frames > 0 ? options_.frames : options_.samples;
    const auto start = Clock::now();
    {
      const ProgressStage stage(progress, "drawing", frames, "frames");
      for (int k = 0; k < frames; ++k) {
        drawing.draw(camera);
        progress.advance();
      }
    }
    const double seconds = since(start);
    session_.say(fmt::format("{}: {} frames in {:.2f} s, {:.1f} ms each", info.renderer, frames,
                             seconds, 1000 * seconds / frames));
    if (options_.screenshot.empty()) return;
    const Image image = drawing.picture().linear_image();
    delivery_.write(options_.screenshot,
                    [&](const std::string& path) { write_one(path, image, tone); });
    delivery_.check();
  }

 private:
  static void write_one(const std::string& path, const Image& image, const ToneMapping& tone) {
    if (extension_of(path) == ".png")
      write_png(path, display_image(image, tone, land_weights(image)),
                {.bits = 8, .srgb = true, .dither = true});
    else
      write_exr(path, image);
  }

  DrawingQuality quality() const {
    if (options_.quality == "low") return DrawingQuality::low;
    return options_.quality == "medium" ? DrawingQuality::medium : DrawingQuality::high;
  }

  inline static const std::vector<std::string> known_{".exr", ".png"};

  const Session& session_;
  ViewOptions options_;
  Delivery delivery_;
};

}  // namespace

void add_view(CLI::App& app, Session& session) {
  auto options = std::make_shared<ViewOptions>();
  CLI::App* command = app.add_subcommand("view", "Fly through a scene");
  command->add_option("scene", options->scene, "The scene's TOML file")
      ->required()
      ->type_name("SCENE");
  command
      ->add_option("--screenshot", options->screenshot,
                   "Write a picture, .png or .exr, without a window")
      ->type_name("FILE");
  command->add_option("--size", options->size, "Size of the picture in pixels")->type_name("WxH");
  command->add_option("--camera", options->camera, "Which of the scene's cameras")
      ->type_name("NAME");
  command->add_option("--samples", options->samples, "Frames whose mean is the screenshot")
      ->check(CLI::Range(1, 65536));
  command->add_option("--frames", options->frames, "Draw so many frames without a window")
      ->check(CLI::Range(1, 1000000));
  command->add_option("--quality", options->quality, "How fine: low, medium or high")
      ->check(CLI::IsMember({"low", "medium", "high"}));
  session.add_scene_options(*command);
  session.add_output_options(*command);
  command->callback([&session, options] {
    std::optional<ThreadLimit> limit;
    if (session.threads > 0) limit.emplace(session.threads);
    OffscreenRun(session, *options).run();
  });
}

}  // namespace wold
