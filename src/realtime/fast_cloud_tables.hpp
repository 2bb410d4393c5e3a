#pragma once
// What is baked of the clouds about an eye, in the air that drifts: their shade on the land
// (landscape/fast_shade.glsl), and sunlight within them (landscape/fast_cloud_light.glsl).

#include <functional>
#include <vector>

#include "gpu/objects.hpp"
#include "realtime/fast_passes.hpp"
#include "realtime/fast_rings.hpp"

namespace wold {

class FastCloudTables {
 public:
  /// `light_size`: texels on a side of a slice of sunlight, a power of two.
  explicit FastCloudTables(int light_size);

  /// Bakes what is new about the eye, in coordinates that drift with the wind; `to_layer` is from
  /// there to where the sun's rays to it enter the clouds, m. Of what is of another sun a part is
  /// baked again as well, or all `at_once`.
  /// `bind` sets uniforms and textures, those of `bind` below among them.
  void bake(FastPasses& passes, const RingTarget& target, DVec2 eye, DVec2 to_layer, bool at_once,
            const std::function<void(const GpuProgram&)>& bind);
  /// All that is baked is of another sun now.
  void sun_moved();
  bool settling() const { return old_shades_ > 0 || old_lights_ > 0; }
  /// Uniforms and textures, these from `unit` on: two.
  void bind(const GpuProgram& program, int unit) const;

 private:
  void bake_shades(FastPasses& passes, const RingTarget& target,
                   const std::vector<RingStrip>& strips,
                   const std::function<void(const GpuProgram&)>& bind);
  void bake_lights(FastPasses& passes, const RingTarget& target,
                   const std::vector<RingStrip>& strips, int first_slice, int end_slice,
                   const std::function<void(const GpuProgram&)>& bind);

  RingSquares shade_squares_;
  RingSquares light_squares_;
  GpuTexture shades_;
  GpuTexture lights_;
  DVec2 shade_middle_{0};
  DVec2 light_middle_{0};
  int next_shade_ = 0;  // level to be baked again
  int next_light_ = 0;  // layer
  int old_shades_ = 0;  // levels baked for another sun
  int old_lights_ = 0;  // layers
};

}  // namespace wold
