#pragma once
// The landscape drawn fast: what the faithful shader (realtime/landscape_picture.hpp) shows, by
// several passes that share work between pixels and frames. OpenGL 3.3.
//
// - The land's function is baked into squares of heights and slopes about the eye, level over
//   level, with a pyramid of maxima over each; a ray goes down and up the pyramid, then the exact
//   function finds the place by Newton's rule (Tevs, Ihrke, Seidel, "Maximum mipmaps for fast,
//   accurate, and scalable dynamic height field rendering", I3D 2008). Only strips are baked anew
//   when the eye moves.
// - Shadows: what a march to the sun would find, baked per place with the distance at which it was
//   found; marched anew at their edges. Shade of clouds: baked in the air that drifts.
// - Air: tables of transmittance and of light scattered more than once; a table of the sky about
//   the eye; few steps before land (Hillaire, "A scalable and production ready sky and atmosphere
//   rendering technique", EGSR 2020).
// - Clouds: sunlight within them from a table that drifts with them, but for the nearest of what
//   shades a place (realtime/fast_cloud_tables.hpp).
// - Pixels: a quarter of them each frame, each round through another place within the pixel; the
//   rest from the frames before, carried along with eye and wind and held to what is near in the
//   new ones (Karis, "High-quality temporal supersampling", SIGGRAPH 2014). So edges and texture
//   are smooth, and of a camera that stands the picture becomes the mean over each pixel.

#include <memory>
#include <optional>

#include "realtime/landscape.hpp"
#include "render/camera.hpp"

namespace wold {

struct FastLandscapeSettings {
  float frame_time = 0;      ///< ms that a frame may take; 0: whatever it takes at full size
  float least_scale = 0.5F;  ///< of the picture's size, to hold that time
  int ring_size = 0;         ///< texels on a side of a baked square; 0: by the picture's size
};

class FastLandscapeDrawing {
 public:
  /// Needs a current context, at its end too.
  explicit FastLandscapeDrawing(const Landscape& landscape,
                                const FastLandscapeSettings& settings = {});
  ~FastLandscapeDrawing();
  FastLandscapeDrawing(FastLandscapeDrawing&&) noexcept;
  FastLandscapeDrawing& operator=(FastLandscapeDrawing&&) noexcept;

  /// Compiles one of its programs ahead, for pictures by a camera or of the flight: how many are
  /// left then. The first picture compiles what is left at once. Throws Error(internal) with the
  /// driver's log, as all that draws.
  int compile_next(bool camera);

  /// Draws over the whole of the bound target, width x height pixels, `time` seconds into the
  /// flight.
  void draw(int width, int height, float time);
  /// The same from a camera of the world's, whose place is measured from the terrain's middle.
  void draw(int width, int height, float time, const Camera& camera);

  /// From the next picture on, degrees: what is baked of its light follows within some pictures, or
  /// in the first after a cut.
  void set_sun(float elevation, float azimuth);
  /// Stops, from the next picture on: EXPOSURE.
  void set_exposure(float stops);

  /// The next picture has nothing to do with the last: all its pixels are new. Found out alone
  /// where the camera leaps or turns far, or time does.
  void cut();
  /// Pictures since the last cut, that one included.
  int frames() const;
  /// Whether some of what is baked is of another sun yet.
  bool settling() const;
  /// Of the picture's size, at which the last one was drawn.
  float scale() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace wold
