#pragma once
// The land's colours, coarsely: what it throws back onto the plants that stand on it.

#include "base/grid.hpp"
#include "render/ground.hpp"

namespace wold {

struct LandColors {
  Grid<Vec3> reflectance{1, 1, Vec3(0.2F)};  ///< linear Rec. 709; as skies have it unless known
  Vec4 place{0};  ///< texture coordinate = zw + xy · place; those outside have the border's
};

/// Of the ground's field.
LandColors land_colors(const Ground& ground);

}  // namespace wold
