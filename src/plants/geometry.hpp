#pragma once
// From a skeleton to triangles.
//
// Each axis becomes one generalised cylinder: a Catmull-Rom curve through its nodes, thinned where
// it is nearly straight, rings of vertices in parallel-transported frames (Wang et al.,
// "Computation of rotation minimizing frames", ACM TOG 27(1), 2008), shared between segments,
// closed at the tip. A branch begins inside its parent. Texture coordinates are metres around (u)
// and along (v).
//
// Radii: as the turtle gave them or, when `twig_radius` > 0, by da Vinci's rule: the cross-sections
// of branches add up as r^e = Σ r_i^e, with the exponent e that leads from `twig_radius` at every
// tip to the turtle's `radius` at the foot.

#include <string>
#include <vector>

#include "base/mesh.hpp"
#include "base/progress.hpp"
#include "plants/organ.hpp"
#include "plants/turtle.hpp"

namespace wold {

struct GeometrySettings {
  float twig_radius = 0;  ///< in the turtle's units; > 0: radii by da Vinci's rule
  float flare = 0;        ///< widening of the foot of the stem, relative to its radius
  float sink = 0;         ///< how far the stem continues below the ground, turtle's units
  std::vector<std::string> colours{"bark"};  ///< materials of branches and polygons by colour
};

/// The mesh scaled to `height` m (0: as it is), with organs; parts sorted by material.
TriangleMesh build_mesh(const Skeleton& skeleton, const GeometrySettings& settings,
                        const std::vector<Organ>& organs, float foot_radius, float height,
                        float detail, std::uint64_t seed, Progress& progress);

}  // namespace wold
