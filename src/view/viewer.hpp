#pragma once
// The heart of `wold view`, without its window: a scene that is flown through, loaded anew when its
// file changes, edited, traced beside; drawn into a picture of its own.
//
// Everything slow happens in the background; each frame takes what is ready. A scene that has
// become invalid leaves the old one where it is, and an error to show.

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/background_job.hpp"
#include "raster/scene_drawing.hpp"
#include "scene/planted_world.hpp"
#include "view/controls.hpp"
#include "view/line_drawing.hpp"
#include "view/pilot.hpp"
#include "view/shader_view.hpp"
#include "view/traced_view.hpp"

namespace wold {

struct ViewerSettings {
  std::filesystem::path scene;
  std::vector<std::string> overrides;  ///< "path=value"
  std::string camera;                  ///< where to begin; empty: the first
  SceneDetail detail;
  bool watch = true;                 ///< loads the scene anew when its file changes
  int traced_samples = 64;           ///< of P
  int traced_size = 640;             ///< pixels on the longer side
  bool shader = false;               ///< begins with the landscape shader's picture
  std::vector<std::string> defines;  ///< its knobs, "NAME=VALUE"
  float shader_frame_time = 0;       ///< ms that it may take, by drawing smaller; 0: any
};

/// What a user should be told.
struct ViewerNotice {
  std::string text;
  bool error = false;
};

/// Frames of the landscape shader, a quarter of the pixels each but in the first, whose mean is a
/// picture of so many rays to each pixel.
inline constexpr int shader_frames(int samples) {
  return 1 + 4 * (samples - 1);
}

/// A scene ready to be looked at.
struct ViewedScene {
  std::shared_ptr<PlantedWorld> world;
  Camera camera;
};

/// Reads and builds a scene, and finds the camera to begin with. Throws as read_scene and
/// PlantedWorld. Any thread.
ViewedScene load_viewed_scene(const ViewerSettings& settings, Progress& progress);

class Viewer {
 public:
  /// Makes what draws the scene. Needs a current context. Throws as SceneDrawing and ShaderView.
  Viewer(ViewerSettings settings, ViewedScene scene, Progress& progress);

  /// Does what the controls ask for, takes what is ready, draws one frame.
  void frame(const Controls& controls);
  /// One frame more of the camera where it is, and nothing else. Throws what makes the shader fail;
  /// `frame` tells it and goes on with the scene.
  void draw();
  void restart_picture();
  /// A window's size in pixels; 0 when it is hidden: then frames draw nothing.
  void resize(int width, int height);
  /// Brings the picture into the bound framebuffer of that size.
  void show(int width, int height) const;

  const Scene& scene() const { return world_->scene(); }
  /// The scene as edited; `edited` must be called after each change.
  Scene& edit() { return edited_; }
  /// What has been changed in `edit()`.
  enum class Change { picture, light, shader, everything };
  void edited(Change change);
  /// Whether what is shown is not what the scene's file says.
  bool is_edited() const { return is_edited_; }

  const std::shared_ptr<PlantedWorld>& world() const { return world_; }
  /// Of the scene as drawn, whether it is shown or the shader's.
  const PictureDrawing& picture() const { return drawing_->picture(); }
  /// R, G, B as a display shows them at an exposure of these stops (of the shader, which sets its
  /// own by the light: so many more than its own).
  Image displayed(float stops) const;
  Image displayed() const { return displayed(exposure_); }
  /// Whether the landscape shader's picture is wanted, and shown.
  bool shader_wanted() const { return shader_wanted_; }
  bool shader_shown() const { return shader_wanted_ && shader_.ready(); }
  /// Makes it, or not.
  void want_shader(bool wanted);
  const ShaderView& shader() const { return shader_; }
  /// Its knobs; `edited(Change::shader)` must be called after each change.
  LandscapeSettings& edit_knobs() { return shader_.knobs(); }
  /// Where its clouds are: s of wind.
  void set_seconds(double seconds) { seconds_ = seconds; }
  /// Stops that a path's view is brighter than usual, of the shader's picture.
  void set_extra_stops(float stops) { extra_stops_ = stops; }
  const SceneDrawing& drawing() const { return *drawing_; }
  const Pilot& pilot() const { return pilot_; }
  void place(const Camera& camera);
  /// Waits until all that the camera sees is there. Throws Error(cancelled), and what makes the
  /// shader fail.
  void settle(Progress& progress);
  Camera camera() const { return camera_of(pilot_); }
  /// m, above the ground.
  float height_above_ground() const;
  /// Stops of the picture as shown.
  float exposure() const { return exposure_; }
  const ToneMapping& tone() const { return edited_.picture; }
  /// The scene as edited, to read.
  const Scene& edited_scene() const { return edited_; }
  /// The scene's name.
  std::string title() const { return settings_.scene.stem().string(); }

  TracedView& traced() { return traced_; }
  const TestRays& rays() const { return rays_; }

  /// Whether a new brightness is got used to slowly; else at once, frame by frame, for films.
  void set_exposure_lag(bool lag) { exposure_lags_ = lag; }

  /// Whether a scene is being loaded, and how far it is.
  bool loading() const { return loading_.busy(); }
  ProgressReport loading_report() const { return loading_.report(); }
  void cancel_loading() { loading_.cancel(); }
  /// The error of the last reload; empty when it was well.
  const std::string& error() const { return error_; }
  /// What to tell the user, once each.
  std::vector<ViewerNotice> take_notices();
  /// Text that the user wants in the clipboard, once.
  std::optional<std::string> take_clipboard();

  /// Scenes built so far.
  int generation() const { return generation_; }
  /// Scenes read from the file so far: what `edit()` holds is another one after each.
  int readings() const { return readings_; }

 private:
  void obey(const Controls& controls);
  void take_loaded();
  void take_rays();
  void watch_files();
  void reload();
  /// Builds a scene in the background; other land at first in few samples, to be seen soon.
  void load(Scene scene, bool from_file);
  void begin_building(Scene scene);
  void use(std::shared_ptr<PlantedWorld> world);
  void take_over();
  void note_file_times();
  void set_hour(double hours);
  float shader_stops() const;
  void adapt_exposure(double seconds);

  ViewerSettings settings_;
  std::shared_ptr<PlantedWorld> world_;
  std::unique_ptr<SceneDrawing> drawing_;
  Scene edited_;
  Pilot pilot_;
  std::vector<Camera> cameras_;
  BackgroundJob<std::shared_ptr<PlantedWorld>> loading_;
  std::optional<Scene> to_refine_;  // what is built once its preview is there
  bool loading_from_file_ = false;
  ShaderView shader_;
  bool shader_wanted_ = false;
  double seconds_ = 0;
  float extra_stops_ = 0;
  float usual_exposure_ = 0;  // stops, of the scene's file
  TracedView traced_;
  BackgroundJob<TestRays> tracing_rays_;
  TestRays rays_;
  LineDrawing lines_;
  int width_ = 0;
  int height_ = 0;
  float exposure_ = 0;
  bool exposure_lags_ = true;
  bool metered_once_ = false;
  float metered_ = 0;
  int frames_to_metering_ = 0;
  bool animate_sun_ = false;
  double seconds_to_watch_ = 0;
  std::vector<std::pair<std::filesystem::path, std::filesystem::file_time_type>> file_times_;
  bool is_edited_ = false;
  std::string error_;
  std::vector<ViewerNotice> notices_;
  std::optional<std::string> clipboard_;
  int generation_ = 0;
  int readings_ = 0;
};

}  // namespace wold
