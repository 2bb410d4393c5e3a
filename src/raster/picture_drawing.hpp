#pragma once
// A picture of what others draw: shadow maps, surfaces, sky and air, smoothed over frames, and
// brought to a display.
//
// Frames of a camera that stands still add up to a mean, each moved by a part of a pixel after
// Halton, so that edges, leaves, soft shadows and clouds become smooth; `frames` says how many.
// While it moves, the last frame is carried on ("raster/resolve.frag.glsl").

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "base/parameters.hpp"
#include "image/image.hpp"
#include "image/tonemap.hpp"
#include "raster/scene_light.hpp"
#include "raster/sky_drawing.hpp"

namespace wold {

/// How fine pictures are drawn: what a viewer on a slow device lowers.
struct PictureQuality {
  int cloud_steps = 64;
  int cloud_light_steps = 6;
  float cloud_scale = 0.5F;  ///< size of the clouds' picture
};

Description<PictureQuality> describe(const PictureQuality&);

class PictureDrawing {
 public:
  /// `light` must outlive this.
  PictureDrawing(SceneLight& light, const PictureQuality& quality = {});

  /// Sizes below 1 are 1: a window may shrink to nothing. Throws Error(limit) beyond the driver's.
  void resize(int width, int height);
  int width() const { return width_; }
  int height() const { return height_; }

  /// Draws surfaces: radiance in cd/m² and depth, or depth alone into a shadow map, for which the
  /// light is nullptr.
  using DrawSurfaces = std::function<void(const DrawView&, const SceneLight*)>;
  /// Draws one frame. With another camera than before, or after `restart`, a new mean begins.
  void draw(const Camera& camera, const DrawSurfaces& surfaces);
  /// What was drawn does not hold any more: the scene has changed.
  void restart() { frames_ = 0; }
  /// The sky has changed: light().set_sky was called.
  void sky_changed();
  /// How many frames are in the mean.
  int frames() const { return frames_; }

  void set_quality(const PictureQuality& quality) { quality_ = quality; }

  /// R, G, B divided by `white_luminance`, and A, the part that is surface: as Film::image has
  /// them.
  Image linear_image() const;
  /// Z: metres along each pixel's ray to what the last frame has there, 0 of the sky.
  Image distances() const;
  /// Brings the picture into the framebuffer that is bound, of that size.
  void show(int width, int height, const ToneMapping& mapping, float stops) const;
  /// The exposure in stops that suits the picture: read back small, as `wold render` meters.
  float metered_exposure() const;

 private:
  const GpuTarget& mean() const { return means_[static_cast<std::size_t>(newest_)]; }

  SceneLight& light_;
  SkyDrawing sky_;
  PictureQuality quality_;
  int width_ = 0;
  int height_ = 0;
  GpuTarget surfaces_;
  GpuTarget frame_;
  std::array<GpuTarget, 2> means_;
  GpuProgram resolve_;
  GpuProgram display_;
  GpuProgram copy_;
  int newest_ = 0;
  int frames_ = 0;
  int number_ = 0;  // of all frames
  std::optional<Camera> last_camera_;
  Mat4 last_view_projection_{1};
  bool fresh_ = true;  // the history shows nothing
};

}  // namespace wold
