#pragma once
// Shadows of the land on itself and its sky visibility, as textures for
// "raster/terrain_shadow.glsl".

#include <vector>

#include "gpu/objects.hpp"
#include "raster/sky_visibility.hpp"
#include "raster/sun_shadow_map.hpp"

namespace wold {

class TerrainShade {
 public:
  static constexpr int units = 3;  ///< textures

  /// Without it nothing is in shade.
  TerrainShade();

  void set(const SunShadowMap& shadows);
  void set(const SkyVisibility& visibility);
  /// Sets the uniforms and textures, from unit `first_unit` on.
  void apply(const GpuProgram& program, int first_unit) const;

 private:
  GpuTexture sun_field_;
  GpuTexture sun_around_;
  GpuTexture sky_;
  std::vector<Vec4> places_ = std::vector<Vec4>(4, Vec4(0));
};

}  // namespace wold
