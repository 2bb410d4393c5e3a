#pragma once
// A scene as its landscape shader draws it (`wold shader`), from any camera: made in the
// background, drawn fast (realtime/fast_landscape.hpp) into a picture of its own.
//
// The land is the shader's function of the place where all terrain steps have one, else the
// finished land as a map. Plants are crowns over the ground; there is no water.

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
  /// The same, waiting until it is there.
  void make(const std::shared_ptr<PlantedWorld>& world, const SkySettings& sky, Vec3 sun);
  bool ready() const { return drawing_.has_value(); }
  bool busy() const { return job_.busy(); }
  ProgressReport report() const { return job_.report(); }
  /// Ends what is being made; what is wanted next is made anew. What was shown stays.
  void cancel();
  /// The same, and nothing stays.
  void forget();

  /// The next picture has nothing to do with the last.
  void cut();
  /// Draws one frame of that size, `seconds` into the wind, brightened by so many stops.
  void draw(const Camera& camera, IVec2 size, float seconds, float stops);
  /// Brings the picture into the bound framebuffer of that size.
  void show(int width, int height) const;
  /// R, G, B as a display shows them.
  Image picture() const;

 private:
  void begin(const std::shared_ptr<PlantedWorld>& world, const SkySettings& sky);
  void take();

  std::vector<std::string> defines_;
  FastLandscapeSettings settings_;
  std::shared_ptr<PlantedWorld> world_;  // wanted
  std::optional<SkySettings> sky_;
  BackgroundJob<Landscape> job_;
  std::optional<FastLandscapeDrawing> drawing_;
  DVec2 middle_{0};     // of the drawn landscape's terrain
  float exposure_ = 0;  // stops, its own
  GpuTarget target_;
};

}  // namespace wold
