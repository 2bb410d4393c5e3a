#include "view/window_loop.hpp"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <chrono>
#include <filesystem>

#include "image/io.hpp"
#include "view/camera_path.hpp"
#include "view/film.hpp"
#include "view/recording.hpp"
#include "view/viewer_screen.hpp"
#include "view/window.hpp"

namespace wold {

namespace {

using Clock = std::chrono::steady_clock;

constexpr float longest_shader_frame = 30;  // ms

/// A window's life from loading to closing.
class WindowLoop {
 public:
  WindowLoop(const WindowLoopSettings& settings, const std::atomic<bool>* interrupted)
      : settings_(settings),
        interrupted_(interrupted),
        window_({.title = "wold - " + settings.viewer.scene.filename().string(),
                 .width = settings.width,
                 .height = settings.height}) {
    const DrawingQuality usual =
        window_.gpu().software ? DrawingQuality::low : DrawingQuality::medium;
    settings_.viewer.detail = scene_detail(settings.quality.value_or(usual));
    settings_.viewer.shader_frame_time = longest_shader_frame;
    if (!settings.record.empty()) recorder_.emplace(settings.record);
    if (!settings.replay.empty()) replayed_ = read_recording(settings.replay);
  }

  WindowLoopResult run() {
    std::optional<ViewedScene> scene = load();
    if (!scene) return {};
    Progress silent;
    Viewer viewer(settings_.viewer, std::move(*scene), silent);
    ViewerScreen screen(viewer, window_.interface());
    WindowLoopResult result;
    const auto start = Clock::now();
    while (!ended(result.frames)) {
      Controls controls = window_.poll();
      if (!settings_.replay.empty()) {
        if (static_cast<std::size_t>(result.frames) >= replayed_.size()) break;
        controls = replayed_[static_cast<std::size_t>(result.frames)];
      }
      if (recorder_) recorder_->add(controls);
      screen.frame(controls, window_.size());
      obey(controls, viewer, screen);
      window_.show();
      ++result.frames;
    }
    result.seconds = std::chrono::duration<double>(Clock::now() - start).count();
    return result;
  }

 private:
  bool ended(int frames) const {
    const bool stop = interrupted_ != nullptr && interrupted_->load();
    return stop || window_.closing() || (settings_.frames > 0 && frames >= settings_.frames);
  }

  /// Nothing if the window was closed meanwhile.
  std::optional<ViewedScene> load() {
    BackgroundJob<ViewedScene> job;
    job.begin([viewer = settings_.viewer](Progress& progress) {
      return load_viewed_scene(viewer, progress);
    });
    for (;;) {
      const Controls controls = window_.poll();
      if (ended(0) || controls.pressed.has(Action::quit)) return std::nullopt;
      if (auto outcome = job.take()) {
        if (const auto* error = std::get_if<Error>(&*outcome)) throw *error;
        return std::get<ViewedScene>(std::move(*outcome));
      }
      show_loading(job.report(), controls.seconds);
    }
  }

  void show_loading(const ProgressReport& report, double seconds) {
    const IVec2 size = window_.size();
    if (size.x <= 0 || size.y <= 0) return;
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glViewport(0, 0, size.x, size.y);
    glClearColor(palette::panel.x, palette::panel.y, palette::panel.z, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    window_.interface().begin(size, seconds);
    const double part = report.total > 0 ? report.done / report.total : -1;
    const std::vector<Task> tasks{{"Building the scene", report.stage, part, true}};
    if (draw_tasks(tasks)) window_.close();
    window_.interface().end();
    window_.show();
  }

  void obey(const Controls& controls, Viewer& viewer, ViewerScreen& screen) {
    const auto pressed = [&](Action action) { return controls.pressed.has(action); };
    if (pressed(Action::quit) && !screen.close_open()) window_.close();
    if (pressed(Action::full_screen)) window_.toggle_full_screen();
    if (const auto text = viewer.take_clipboard()) window_.set_clipboard(*text);
    try {
      if (pressed(Action::screenshot)) take_shot(viewer, screen);
      if (pressed(Action::add_path_key)) add_key(viewer, screen);
    } catch (const Error& error) {
      screen.messages().error("file", error.message());
    }
  }

  void take_shot(const Viewer& viewer, ViewerScreen& screen) const {
    const FramePattern pattern(settings_.shots);
    int number = 1;
    while (std::filesystem::exists(pattern.name(number))) ++number;
    write_png(pattern.name(number), viewer.displayed(),
              {.bits = 8, .srgb = true, .dither = !viewer.shader_shown()});
    screen.messages().notice("saved " + pattern.name(number));
  }

  void add_key(const Viewer& viewer, ViewerScreen& screen) {
    const Camera camera = viewer.camera();
    CameraKey key;
    key.position = DVec3(camera.position);
    key.time = next_key_time(settings_.path_file, key.position);
    key.direction = DVec3(camera.direction);
    key.field_of_view = camera.field_of_view;
    append_key(settings_.path_file, key);
    screen.messages().notice(
        fmt::format("key at {:.1f} s added to {}", key.time, settings_.path_file));
  }

  WindowLoopSettings settings_;
  const std::atomic<bool>* interrupted_;
  Window window_;
  std::optional<Recorder> recorder_;
  std::vector<Controls> replayed_;
};

}  // namespace

WindowLoopResult run_window(const WindowLoopSettings& settings,
                            const std::atomic<bool>* interrupted) {
  return WindowLoop(settings, interrupted).run();
}

}  // namespace wold
