#pragma once
// Triangulation of a simple polygon in space.

#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.hpp"

namespace wold {

/// The normal of a polygon by Newell's sum, unit length; zero for a polygon without area.
Vec3 polygon_normal(std::span<const Vec3> vertices);

/// Triangles as indices into `vertices`, by cutting off ears (Meisters 1975); n - 2 of them for n
/// vertices. A polygon that crosses itself gives triangles all the same, if not good ones.
std::vector<UVec3> triangulate(std::span<const Vec3> vertices);

}  // namespace wold
