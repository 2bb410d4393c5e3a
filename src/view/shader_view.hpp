#pragma once
// A scene as its landscape shader draws it (`wold shader`), from any camera: made in the
// background, compiled program by program between frames, drawn fast (realtime/fast_landscape.hpp)
// into a picture of its own. What was shown stays until what comes next is ready.
//
// The land is the shader's function of the place where all terrain steps have one, else the
// finished land as maps, with its water, its covers, and trees where the scene has them.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/background_job.hpp"
#include "gpu/objects.hpp"
#include "image/image.hpp"
#include "realtime/fast_landscape.hpp"
#include "scene/planted_world.hpp"

namespace wold {

class ShaderView {
 public:
  /// `defines`: knobs as "NAME=VALUE", of all landscapes to come. Throws Error(usage).
  ShaderView(std::vector<std::string> defines, const FastLandscapeSettings& settings);

  /// What is to be shown: a world under a sky, with the sun in this direction. Makes what differs
  /// from what was wanted before, and takes what is ready. Needs a current context. Throws what
  /// made a landscape fail, once.
  void want(const std::shared_ptr<PlantedWorld>& world, const SkySettings& sky, Vec3 sun);
  /// The same, waiting until it is there. Throws Error(cancelled) once `progress` is.
  void make(const std::shared_ptr<PlantedWorld>& world, const SkySettings& sky, Vec3 sun,
            Progress& progress);
  bool ready() const { return drawing_.has_value(); }
  bool busy() const { return job_.busy() || next_.has_value(); }
  ProgressReport report() const;
  /// Ends what is being made; what is wanted next is made anew. What was shown stays.
  void cancel();
  /// The same, and nothing stays.
  void forget();

  /// The knobs of what is shown, and of what comes: to be changed, then `knobs_changed`.
  LandscapeSettings& knobs() { return knobs_; }
  /// As the scene (and `defines`) have them.
  const LandscapeSettings& scene_knobs() const { return landscape_.settings; }
  /// All knobs but those that sun, camera and exposure of the view set.
  static ParameterSet free_knobs();
  /// Compiles the landscape anew with its knobs as they are now; what is being made gets them too.
  void knobs_changed();
  /// Landscapes made so far: `scene_knobs` may be others after each.
  int generation() const { return generation_; }

  /// The next picture has nothing to do with the last.
  void cut();
  /// Draws one frame of that size, `seconds` into the wind, brightened by so many stops.
  void draw(const Camera& camera, IVec2 size, float seconds, float stops);
  /// Of the size asked for, at which the last frame was drawn.
  float scale() const { return drawing_ ? drawing_->scale() : 1; }
  /// Stops of the last frame.
  float stops() const { return stops_; }
  /// Brings the picture into the bound framebuffer of that size.
  void show(int width, int height) const;
  /// R, G, B as a display shows them.
  Image picture() const;

 private:
  void begin(const std::shared_ptr<PlantedWorld>& world, const SkySettings& sky);
  void take();
  void compile();
  void compile_next();

  /// A landscape on its way to be shown.
  struct Next {
    FastLandscapeDrawing drawing;
    LandscapeSettings knobs;
    DVec2 middle{0};  ///< of its terrain
    int programs = 0;
    int left = 0;  ///< of them to be compiled
  };

  std::vector<std::string> defines_;
  FastLandscapeSettings settings_;
  std::shared_ptr<PlantedWorld> world_;  // wanted
  std::optional<SkySettings> sky_;
  BackgroundJob<Landscape> job_;
  Landscape landscape_;  // with the scene's knobs
  LandscapeSettings knobs_;
  LandscapeSettings shown_knobs_;  // of drawing_
  std::optional<Next> next_;
  std::optional<FastLandscapeDrawing> drawing_;
  DVec2 middle_{0};
  float exposure_ = 0;  // stops, its own
  float stops_ = 0;
  int generation_ = 0;
  GpuTarget target_;
};

}  // namespace wold
