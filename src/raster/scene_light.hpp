#pragma once
// The light of a scene for everything that is drawn: sun with its shadows, and sky from all around.
// One set of textures and uniforms, that of "raster/light.glsl".

#include <array>

#include "gpu/objects.hpp"
#include "raster/canopy_shade.hpp"
#include "raster/draw_view.hpp"
#include "raster/land_colors.hpp"
#include "raster/shadow_maps.hpp"
#include "raster/terrain_shade.hpp"
#include "sky/sky.hpp"

namespace wold {

/// Texture units 7 and up belong to the light; 0 to 6 are free for what is drawn.
inline constexpr int first_light_unit = 8;

/// Irradiance in lx of a surface by its direction, as nine spherical harmonics with the constants
/// of the cosine and of the bands in them: Ramamoorthi, Hanrahan, SIGGRAPH 2001.
std::array<Vec3, 9> sky_harmonics(const Sky& sky);
/// Mean radiance below the horizon, by cosine to the nadir, cd/m².
Vec3 radiance_below(const Sky& sky);

class SceneLight {
 public:
  explicit SceneLight(Sky sky, const ShadowSettings& shadows = {});

  /// The moment changes.
  void set_sky(Sky sky);
  void set_canopy(const CanopyShade& canopy);
  void set_undergrowth(const CanopyShade& undergrowth);
  void set_land_colors(const LandColors& colors);
  ShadowMaps& shadows() { return shadows_; }
  /// What the land hides of sun and sky, beyond shadow maps.
  TerrainShade& terrain_shade() { return terrain_shade_; }
  /// Turns the samples of shadows; another number for each frame.
  void set_frame(int frame) { frame_ = frame; }
  int frame() const { return frame_; }

  /// Sets the uniforms and textures of "raster/light.glsl" of a program that includes it.
  void apply(const GpuProgram& program) const;

  const Sky& sky() const { return sky_; }
  const GpuTexture& sky_table() const { return table_; }

 private:
  Sky sky_;
  std::array<Vec3, 9> harmonics_{};
  Vec3 below_{0};  // cd/m²
  GpuTexture table_;
  GpuTexture canopy_map_;
  Vec4 canopy_place_{0};
  GpuTexture undergrowth_map_;
  Vec4 undergrowth_place_{0};
  GpuTexture land_colors_;
  Vec4 land_place_{0};
  ShadowMaps shadows_;
  TerrainShade terrain_shade_;
  int frame_ = 0;
};

/// A table of class Sky as a texture.
GpuTexture sky_texture(const Grid<Vec3>& nodes);

}  // namespace wold
