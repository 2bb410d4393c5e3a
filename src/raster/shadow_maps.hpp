#pragma once
// Shadows of the sun near the eye: four maps of depth as the sun sees it, each four times as wide
// as the one before, two by two in one texture.
//
// A map is a box about the place where the eye was when it was drawn; it is drawn anew once the eye
// has left its middle or the sun has moved, and its middle lies on whole texels, so that shadows
// neither swim nor cost anything while one only looks around.
//
// The finer two have the land in them, and what is lit is lifted off it by a texel. In the coarser
// that would part trees from their shadows; there the land's own shade is that of
// raster/sun_shadow_map.hpp alone.

#include <array>
#include <functional>

#include "gpu/objects.hpp"
#include "raster/draw_view.hpp"

namespace wold {

inline constexpr int shadow_cascades = 4;

struct ShadowSettings {
  int size = 2048;  ///< pixels on a side of a map, fewer where the driver has no more; 0: none
  float nearest_radius = 14;  ///< m, half the width of the first
  float ratio = 4.5F;         ///< from one to the next
};

class ShadowMaps {
 public:
  explicit ShadowMaps(const ShadowSettings& settings);

  /// Draws the maps that need it. `draw` draws all that throws a shadow into the bound target.
  /// Leaves another target bound.
  void update(const DrawView& camera, Vec3 towards_sun,
              const std::function<void(const DrawView&)>& draw);
  /// To be called when what throws shadows has changed.
  void forget() { drawn_ = {}; }
  /// Sets the uniforms of "raster/shadows.glsl"; the texture goes to `unit`. `turn` in radians.
  void apply(const GpuProgram& program, int unit, float turn) const;

 private:
  float radius(int cascade) const;

  ShadowSettings settings_;
  GpuTarget atlas_;
  std::array<Mat4, shadow_cascades> matrices_{};
  std::array<Vec3, shadow_cascades> centres_{};
  std::array<bool, shadow_cascades> drawn_{};
  Vec3 sun_{0, 0, 1};
};

}  // namespace wold
