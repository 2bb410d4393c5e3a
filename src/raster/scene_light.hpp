#pragma once
// The light of a scene for everything that is drawn: sun with its shadows, sky from all around,
// and the air between surface and eye. One set of textures and uniforms, that of
// "raster/light.glsl".

#include "gpu/objects.hpp"
#include "raster/draw_view.hpp"
#include "sky/sky.hpp"

namespace wold {

/// Texture units 8 and up belong to the light; 0 to 7 are free for what is drawn.
inline constexpr int first_light_unit = 8;

class SceneLight {
 public:
  explicit SceneLight(const Sky& sky);

  /// Sets the uniforms and textures of "raster/light.glsl" of a program that includes it.
  void apply(const GpuProgram& program) const;

  const Sky& sky() const { return *sky_; }

 private:
  const Sky* sky_;
};

}  // namespace wold
