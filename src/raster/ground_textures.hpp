#pragma once
// What "render/ground_heights.glsl" and "render/ground.glsl" read: heights, water levels and maps
// of covers as textures, the noises of the ground, and its material as uniforms.
//
// Places in the shader are relative to an anchor near the eye. Here, in double, it is worked out
// where the anchor lies in each grid and in the lattice of each octave of each noise: a whole cell
// and a fraction. So detail of centimetres keeps its shape 100 km from the world's origin.
//
// At most eight covers are drawn, the first ones; more are left out. Maps of covers that have not
// all the same samples are resampled (bilinear) to those of the largest.

#include <vector>

#include "gpu/objects.hpp"
#include "render/ground.hpp"

namespace wold {

inline constexpr int most_drawn_covers = 8;

class GroundTextures {
 public:
  explicit GroundTextures(const Ground& ground);

  /// Another ground, or the same changed: heights, maps and material are uploaded again.
  void update(const Ground& ground);
  /// Puts the anchor at a place of the world, m; costs little where it stays.
  void move_anchor(DVec2 anchor);
  /// Sets uniforms of a program that includes the files above, and binds texture units 0 to 6.
  void apply(const GpuProgram& program) const;

 private:
  struct Placed {
    IVec2 size{2};
    DVec2 origin{0};
    double cell = 1;
  };
  struct Maps {
    GpuTexture texture;
    Placed grid;
    std::vector<bool> present;
  };

  Maps cover_maps(bool inner) const;
  void set_grid(const GpuProgram& program, const char* name, const Placed& grid) const;
  void set_covers(const GpuProgram& program) const;
  void set_material(const GpuProgram& program) const;

  const Ground* ground_;
  DVec2 anchor_{0};
  GpuTexture field_;
  GpuTexture around_;
  GpuTexture inner_water_;
  GpuTexture outer_water_;
  GpuTexture octaves_;
  Maps inner_covers_;
  Maps outer_covers_;
};

}  // namespace wold
