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
  /// there to where the sun's rays to it enter the clouds, m. With a sun that moves, a part of what
  /// is there as well.
  /// `bind` sets uniforms and textures, those of `bind` below among them.
  void bake(FastPasses& passes, const RingTarget& target, DVec2 eye, DVec2 to_layer, bool sun_moves,
            const std::function<void(const GpuProgram&)>& bind);
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
  int next_layer_ = 0;  // to be baked again
};

}  // namespace wold
