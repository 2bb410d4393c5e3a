#pragma once
// What everything that is drawn needs to know of the view: where from, through which matrix, how
// fine.

#include <array>

#include "base/vec.hpp"
#include "gpu/objects.hpp"
#include "render/camera.hpp"

namespace wold {

/// A view to draw into: the camera's, or that of a shadow map.
struct DrawView {
  Mat4 view_projection{1};    ///< world to clip space
  Vec3 eye{0};                ///< the camera's place, m; for shadows too: detail is chosen by it
  float pixel_angle = 1e-3F;  ///< radians between the camera's pixels
  bool depth_only = false;    ///< a shadow map: no colours
  bool without_land = false;  ///< a coarse one, in which the land would shade itself
  /// World half-spaces a·p + d >= 0 that hold all that is seen: left, right, bottom, top, near.
  std::array<Vec4, 5> planes{};
  // Of the camera: the ray through a point of the picture, x and y from -1 to 1 to the right and
  // up, is forward + x · right + y · above.
  Vec3 forward{0, 1, 0};
  Vec3 right{1, 0, 0};
  Vec3 above{0, 0, 1};
  float nearest = 0.1F;  ///< m along `forward`

  /// Whether a box may be seen.
  bool sees(Vec3 low, Vec3 high) const;
  bool sees_sphere(Vec3 centre, float radius) const;
  /// Sets the uniforms of "raster/view.glsl".
  void apply(const GpuProgram& program) const;
};

/// Reversed depth: 1 at `nearest` metres, falling to 0 at infinity. `jitter`, in pixels, moves the
/// picture by less than one.
DrawView camera_view(const Camera& camera, int width, int height, float nearest = 0.1F,
                     Vec2 jitter = Vec2(0));

/// Depth 1 at the side of `towards_light`, 0 at the far side of the box of half-sizes `half` about
/// `centre`: x, y across, z along the light.
DrawView shadow_view(const DrawView& camera, Vec3 centre, Vec3 towards_light, Vec3 half);

/// Depth in [0, 1] with 1 nearest, as both views have it. Once per context. Returns false where the
/// driver has no clip control (OpenGL 4.5): then depth is coarse far away.
bool use_reversed_depth();
/// (x, y) such that x + y · depth as stored is the depth of the views above.
Vec2 stored_depth_range();

}  // namespace wold
