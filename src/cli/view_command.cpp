#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
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
#include "realtime/landscape_picture.hpp"
#include "view/film_maker.hpp"
#include "view/recording.hpp"
#include "view/viewer_screen.hpp"
#include "view/window_loop.hpp"

namespace wold {

namespace {

using Clock = std::chrono::steady_clock;

struct ViewOptions {
  std::string scene;
  std::string screenshot;
  std::string size;
  std::string camera;
  std::string quality;
  std::string frames;
  std::string path;
  std::string output = "frame_%04d.png";
  std::string renderer = "drawn";
  std::vector<std::string> defines;
  std::string video;
  std::string record;
  std::string replay;
  int samples = 0;
  double frames_per_second = 25;
  bool resume = false;
  bool interface = false;
};

const std::vector<std::string> picture_names{".exr", ".png"};

double since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

std::optional<DrawingQuality> quality_of(const std::string& name) {
  if (name.empty()) return std::nullopt;
  if (name == "low") return DrawingQuality::low;
  return name == "medium" ? DrawingQuality::medium : DrawingQuality::high;
}

ViewerSettings viewer_settings(const Session& session, const ViewOptions& options) {
  ViewerSettings settings;
  settings.scene = options.scene;
  settings.overrides = session.overrides();
  if (!options.size.empty()) settings.overrides.push_back(size_override(options.size));
  settings.camera = options.camera;
  settings.shader = options.renderer == "shader";
  settings.defines = options.defines;
  LandscapeSettings checked;
  set_knobs(checked, options.defines);
  return settings;
}

/// Milliseconds of frames, as users compare them.
struct FrameTimes {
  double median = 0;
  double worst = 0;
  double per_second = 0;
};

FrameTimes frame_times(std::vector<double> milliseconds) {
  if (milliseconds.empty()) return {};
  double sum = 0;
  for (const double ms : milliseconds) sum += ms;
  std::sort(milliseconds.begin(), milliseconds.end());
  return {milliseconds[milliseconds.size() / 2], milliseconds.back(),
          1000 * static_cast<double>(milliseconds.size()) / sum};
}

/// Pictures without a window: a still, a number of frames, a recorded session or a film.
class OffscreenRun {
 public:
  OffscreenRun(const Session& session, ViewOptions options)
      : session_(session), options_(std::move(options)) {}

  void run() {
    prepare();
    const OffscreenContext context;
    const GpuInfo gpu = gpu_info();
    Progress progress = session_.progress();
    const auto start = Clock::now();
    ViewedScene scene = load_viewed_scene(settings_, progress);
    Viewer viewer(settings_, std::move(scene), progress);
    viewer.set_exposure_lag(false);
    const double loading = since(start);
    const IVec2 size = viewer.scene().render.size;
    viewer.resize(size.x, size.y);
    const auto drawing = Clock::now();
    if (!options_.path.empty())
      film(viewer, progress);
    else
      draw_frames(viewer, progress);
    report(viewer, gpu, loading, since(drawing));
    delivery_.check();
    if (interrupted_)
      throw Error(ErrorKind::cancelled,
                  fmt::format("interrupted; the picture so far, of {} frames, is in {}", frames_,
                              fmt::join(outputs_, " and ")));
  }

 private:
  /// Everything that can be wrong is found before any work.
  void prepare() {
    settings_ = viewer_settings(session_, options_);
    settings_.watch = false;
    const bool still = !options_.screenshot.empty() || !options_.path.empty();
    settings_.detail = scene_detail(
        quality_of(options_.quality).value_or(still ? DrawingQuality::high : DrawingQuality::low));
    if (!settings_.shader && !options_.defines.empty())
      throw Error(ErrorKind::usage,
                  "--define sets knobs of the shader: it wants --renderer shader");
    if (!options_.screenshot.empty()) check_writable(options_.screenshot, endings());
    if (!options_.replay.empty()) replayed_ = read_recording(options_.replay);
    if (!options_.path.empty()) prepare_film();
  }

  /// The shader's pictures are colours of a display.
  std::vector<std::string> endings() const {
    return settings_.shader ? std::vector<std::string>{".png"} : picture_names;
  }

  void prepare_film() {
    film_.frames = FramePattern(options_.output);
    film_.path = read_camera_path(options_.path);
    check_writable(film_.frames.name(0), endings());
    if (!options_.frames.empty()) film_.range = parse_frame_range(options_.frames);
    film_.frames_per_second = options_.frames_per_second;
    film_.resume = options_.resume;
    film_.renderer = options_.renderer == "traced"   ? FilmRenderer::traced
                     : options_.renderer == "shader" ? FilmRenderer::shader
                                                     : FilmRenderer::drawn;
    if (!options_.video.empty()) check_video_writable(options_.video, film_.frames);
  }

  void film(Viewer& viewer, Progress& progress) {
    film_.size = viewer.scene().render.size;
    const int usual =
        film_.renderer == FilmRenderer::traced ? viewer.scene().render.samples : film_samples;
    film_.samples = options_.samples > 0 ? options_.samples : usual;
    frames_ = make_film(viewer, film_, progress);
    if (options_.video.empty()) return;
    const FrameRange range = film_.range.value_or(all_frames(film_.path, film_.frames_per_second));
    write_video(options_.video, film_.frames, range,
                {.frames_per_second = film_.frames_per_second});
    outputs_.push_back(options_.video);
  }

  /// How many frames are asked for: given, recorded, or enough for a smooth still.
  int frame_count() const {
    if (!replayed_.empty()) return static_cast<int>(replayed_.size());
    if (!options_.frames.empty()) return parse_frame_range(options_.frames).count();
    const int samples = options_.samples > 0 ? options_.samples : still_samples;
    return settings_.shader ? shader_frames(samples) : samples;
  }

  void draw_frames(Viewer& viewer, Progress& progress) {
    const int count = frame_count();
    const IVec2 size(viewer.picture().width(), viewer.picture().height());
    const GpuTarget screen(size.x, size.y, std::array{PixelFormat::rgba8}, false);
    std::optional<Interface> interface;
    std::optional<ViewerScreen> shown;
    if (options_.interface) {
      interface.emplace();
      shown.emplace(viewer, *interface);
    }
    viewer.settle(progress);
    try {
      const ProgressStage stage(progress, "drawing", count, "frames");
      while (frames_ < count) {
        Controls controls;
        // A still is of one moment.
        controls.seconds = options_.frames.empty() ? 0 : 1.0 / 60;
        if (!replayed_.empty()) controls = replayed_[static_cast<std::size_t>(frames_)];
        GpuTimer timer;
        timer.begin();
        if (shown)
          shown->frame(controls, size, screen.id());
        else
          viewer.frame(controls);
        milliseconds_.push_back(timer.end());
        check_notices(viewer);
        ++frames_;
        progress.advance();
      }
    } catch (const Error& error) {
      // A still of fewer frames is a still.
      if (error.kind() != ErrorKind::cancelled || options_.screenshot.empty()) throw;
      interrupted_ = true;
    }
    if (!options_.screenshot.empty()) write_still(viewer, options_.interface ? &screen : nullptr);
  }

  /// What a window would tell and go on is an error of a picture.
  static void check_notices(Viewer& viewer) {
    for (const ViewerNotice& notice : viewer.take_notices())
      if (notice.error) throw Error(ErrorKind::internal, notice.text);
  }

  void write_still(const Viewer& viewer, const GpuTarget* screen) {
    const std::string written = delivery_.write(options_.screenshot, [&](const std::string& path) {
      if (extension_of(path) == ".exr") return write_exr(path, viewer.picture().linear_image());
      const Image display = screen != nullptr ? shown_image(*screen) : viewer.displayed();
      const bool dither = screen == nullptr && !viewer.shader_shown();
      write_png(path, display, {.bits = 8, .srgb = true, .dither = dither});
    });
    if (!written.empty()) outputs_.push_back(written);
  }

  void report(const Viewer& viewer, const GpuInfo& gpu, double loading, double seconds) const {
    const IVec2 size = viewer.scene().render.size;
    const FrameTimes times = frame_times(milliseconds_);
    std::string what =
        fmt::format("{} frames of {} x {} in {}", frames_, size.x, size.y, duration_text(seconds));
    if (times.median > 0) what += fmt::format(", {:.1f} ms each (median)", times.median);
    session_.say(fmt::format("{} by {}", what, gpu.renderer));
    if (!outputs_.empty()) session_.say(fmt::format("wrote {}", fmt::join(outputs_, " and ")));
    session_.print({{"command", "view"},
                    {"scene", options_.scene},
                    {"outputs", outputs_},
                    {"device", gpu.renderer},
                    {"opengl", gpu.version},
                    {"size", {size.x, size.y}},
                    {"frames", frames_},
                    {"seconds", {{"scene", loading}, {"drawing", seconds}}},
                    {"milliseconds", {{"median", times.median}, {"worst", times.worst}}},
                    {"frames_per_second", times.per_second},
                    {"triangles", viewer.drawing().drawn_triangles()},
                    {"peak_memory_bytes", peak_memory()}});
  }

  static constexpr int still_samples = 24;
  static constexpr int film_samples = 12;

  const Session& session_;
  ViewOptions options_;
  ViewerSettings settings_;
  FilmSettings film_;
  std::vector<Controls> replayed_;
  std::vector<double> milliseconds_;
  std::vector<std::string> outputs_;
  int frames_ = 0;
  bool interrupted_ = false;
  Delivery delivery_;
};

void run_in_window(const Session& session, const ViewOptions& options) {
  WindowLoopSettings settings;
  settings.viewer = viewer_settings(session, options);
  read_scene(settings.viewer.scene, settings.viewer.overrides).camera(options.camera);
  settings.quality = quality_of(options.quality);
  settings.record = options.record;
  settings.path_file = std::filesystem::path(options.scene).stem().string() + "-camera.toml";
  if (!options.size.empty()) {
    const IVec2 size = parse_size(options.size);
    settings.width = size.x;
    settings.height = size.y;
  }
  const WindowLoopResult result = run_window(settings, session.interrupted);
  session.print({{"command", "view"},
                 {"scene", options.scene},
                 {"frames", result.frames},
                 {"seconds", {{"flying", result.seconds}}},
                 {"peak_memory_bytes", peak_memory()}});
}

void add_view_options(CLI::App& command, ViewOptions& options) {
  command.add_option("scene", options.scene, "The scene's TOML file")
      ->required()
      ->type_name("SCENE");
  command.add_option("--size", options.size, "Size of window or picture in pixels")
      ->type_name("WxH");
  command.add_option("--camera", options.camera, "Which of the scene's cameras to begin at")
      ->type_name("NAME");
  command
      .add_option("--quality", options.quality,
                  "low, medium or high; else by the device, and high for pictures")
      ->check(CLI::IsMember({"low", "medium", "high"}));
  command
      .add_option("--renderer", options.renderer,
                  "drawn; shader: the land as `wold shader` exports it; films: traced, too")
      ->check(CLI::IsMember({"drawn", "shader", "traced"}));
  command
      .add_option("--define", options.defines,
                  "Sets a knob of the shader; may be given more than once")
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false);
  command.add_option("--record", options.record, "Write the session's controls to a file")
      ->type_name("FILE");
  const std::string offscreen = "Without a window";
  command.add_option("--screenshot", options.screenshot, "Write a picture, .png or .exr, and end")
      ->type_name("FILE")
      ->group(offscreen);
  command
      .add_option("--samples", options.samples, "Frames (or light paths) whose mean is a picture")
      ->check(CLI::Range(1, 65536))
      ->group(offscreen);
  command
      .add_option("--frames", options.frames,
                  "Draw so many frames and tell their speed; of a film, the frames to make")
      ->type_name("N|A:B")
      ->group(offscreen);
  command.add_option("--replay", options.replay, "Fly a recorded session again")
      ->type_name("FILE")
      ->group(offscreen);
  command.add_flag("--interface", options.interface, "Show panel and help in the picture, too")
      ->group(offscreen);
  const std::string film = "Films";
  command.add_option("--path", options.path, "Fly along a path of camera keys")
      ->type_name("FILE")
      ->group(film);
  command.add_option("-o,--output", options.output, "Names of the frames, such as frame_%04d.png")
      ->type_name("PATTERN")
      ->group(film);
  command.add_option("--fps", options.frames_per_second, "Frames per second")
      ->check(CLI::Range(0.01, 1000.0))
      ->group(film);
  command.add_option("--video", options.video, "Also make a video, .mp4, with FFmpeg")
      ->type_name("FILE")
      ->group(film);
  command.add_flag("--resume", options.resume, "Leave out frames that are there already")
      ->group(film);
}

}  // namespace

void add_view(CLI::App& app, Session& session) {
  auto options = std::make_shared<ViewOptions>();
  CLI::App* command = app.add_subcommand("view", "Fly through a scene, in a window");
  add_view_options(*command, *options);
  session.add_scene_options(*command);
  session.add_output_options(*command);
  command->callback([&session, options] {
    std::optional<ThreadLimit> limit;
    if (session.threads > 0) limit.emplace(session.threads);
    const bool offscreen = !options->screenshot.empty() || !options->frames.empty() ||
                           !options->path.empty() || !options->replay.empty();
    if (options->renderer == "traced" && options->path.empty())
      throw Error(ErrorKind::usage,
                  "--renderer traced is for films, with --path; a traced still is `wold render`'s, "
                  "and P traces in the window");
    if (offscreen)
      OffscreenRun(session, *options).run();
    else
      run_in_window(session, *options);
  });
}

}  // namespace wold
