#pragma once
// The surface of one branch: a generalised cylinder around a curve.

#include <cstdint>
#include <vector>

#include "base/mesh.hpp"
#include "plants/turtle.hpp"

namespace wold {

struct BranchStyle {
  float tolerance = 0.001F;  ///< by which the curve may be simplified, turtle's units
  int sides = 6;
  bool pointed = false;    ///< narrows to a point at its last node instead of being rounded off
  float flare = 0;         ///< widening of a foot, relative to its radius; 0 for branches
  float sink = 0;          ///< how far a foot goes on below its first node
  std::uint64_t seed = 0;  ///< of the shape of the roots
};

/// Adds vertices and triangles; parts are left to the caller. The surface is closed: where vertices
/// are doubled (the seam of the texture) their positions are equal.
void add_branch(TriangleMesh& mesh, const std::vector<Skeleton::Node>& nodes,
                const BranchStyle& style);

}  // namespace wold
