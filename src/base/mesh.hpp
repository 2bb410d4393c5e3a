#pragma once
// A triangle mesh whose triangles are sorted into parts, one per material.

#include <cstdint>
#include <string>
#include <vector>

#include "base/vec.hpp"

namespace wold {

struct MeshPart {
  std::string material;  ///< "bark", "leaf": a material's name, resolved by who renders it
  std::uint32_t first_triangle = 0;
  std::uint32_t triangle_count = 0;
};

/// Counter-clockwise seen from outside. `normals` and `uvs` are empty or one per position.
struct TriangleMesh {
  std::vector<Vec3> positions;  ///< m
  std::vector<Vec3> normals;    ///< unit length
  std::vector<Vec2> uvs;        ///< along bark in metres; leaves in [0, 1]²
  std::vector<UVec3> triangles;
  std::vector<MeshPart> parts;  ///< cover all triangles in order

  struct Bounds {
    Vec3 low{0};
    Vec3 high{0};
  };
  Bounds bounds() const {
    if (positions.empty()) return {};
    Bounds b{positions.front(), positions.front()};
    for (const Vec3& p : positions) {
      b.low = glm::min(b.low, p);
      b.high = glm::max(b.high, p);
    }
    return b;
  }
};

}  // namespace wold
