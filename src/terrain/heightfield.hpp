#pragma once
// A heightfield: ground heights on a regular grid with a place and a size in the world.

#include "base/grid.hpp"
#include "base/vec.hpp"

namespace wold {

/// Sample (i, j) lies at origin + cell · (i, j); heights in metres above the scene's zero. Value
/// type.
struct Heightfield {
  Grid<float> height;  ///< m
  DVec2 origin{0};     ///< m, place of sample (0, 0), the south-west corner
  double cell = 1;     ///< m, distance between neighbours

  /// Extent between the outermost samples, m.
  DVec2 size() const { return {cell * (height.width() - 1), cell * (height.height() - 1)}; }
  bool contains(DVec2 place) const;
};

/// Height and slope at a place; outside, of the nearest place on the border.
struct GroundSample {
  float height = 0;  ///< m
  Vec2 gradient{0};  ///< dh/dx, dh/dy
};

/// Bicubic (Catmull-Rom): continuous height and gradient.
GroundSample ground_at(const Heightfield& field, DVec2 place);

/// Bilinear: what a grid of flat quads would have, faster; outside, of the nearest place.
float height_at(const Heightfield& field, DVec2 place);

/// Upward unit normal from a gradient.
Vec3 normal_of(Vec2 gradient);

}  // namespace wold
