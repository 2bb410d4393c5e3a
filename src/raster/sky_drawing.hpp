#pragma once
// What is not surface: the sky behind, the air before, the clouds between.

#include <string>

#include "gpu/objects.hpp"
#include "raster/draw_view.hpp"
#include "sky/clouds.hpp"
#include "sky/sky.hpp"

namespace wold {

class SkyDrawing {
 public:
  explicit SkyDrawing(const Sky& sky);

  /// The moment changes.
  void set_sky(const Sky& sky);

  struct Frame {
    const DrawView* view = nullptr;
    const GpuTexture* surfaces = nullptr;  ///< radiance, cd/m²
    const GpuTexture* depth = nullptr;
    int number = 0;  ///< turns the samples of clouds
    CloudSteps clouds;
    float cloud_scale = 1;  ///< size of the clouds' picture; 1/2 is nearly as good
  };
  /// Draws surfaces, air, sky and clouds into `out`: cd/m², with 1 in alpha where a surface is.
  void draw(const Frame& frame, const GpuTarget& out);

 private:
  void apply_air(const GpuProgram& program, int first_unit) const;
  void draw_clouds(const Frame& frame, int width, int height);

  SkyParts parts_;
  Vec3 sun_direction_{0, 0, 1};
  GpuTexture clear_sky_;
  GpuTexture air_table_;
  GpuTexture light_by_height_;
  GpuTarget clouds_;
  GpuProgram composite_;
  GpuProgram cloud_program_;
};

/// Set the uniforms of a struct of that name.
void apply_atmosphere(const GpuProgram& program, const std::string& name,
                      const Atmosphere& atmosphere);
void apply_clouds(const GpuProgram& program, const std::string& name, const Clouds& clouds);

/// Sets the uniforms of "raster/picture.glsl" but for the texture, which is at `unit`.
void apply_picture(const GpuProgram& program, const DrawView& view, const GpuTexture& depth,
                   int unit);

}  // namespace wold
