#pragma once
// From a skeleton to triangles.
//
// Each axis becomes one generalised cylinder: a Catmull-Rom curve through its nodes, thinned where
// it is nearly straight, rings of vertices in parallel-transported frames (Wang et al.,
// "Computation of rotation minimizing frames", ACM TOG 27(1), 2008), shared between segments,
// closed at its ends. A branch begins inside its parent; a stem that ends in a fork goes on as its
// strongest branch. Texture coordinates are metres around (u) and along (v).
//
// Radii: as the turtle gave them or, when `twig_radius` > 0, by da Vinci's rule: the cross-sections
// of branches add up as r^e = Σ r_i^e, with the exponent e that leads from `twig_radius` at every
// tip to the turtle's `radius` at the foot.

#include <string>
#include <vector>

#include "base/mesh.hpp"
#include "base/parameters.hpp"
#include "base/progress.hpp"
#include "plants/organ.hpp"
#include "plants/turtle.hpp"

namespace wold {

struct GeometrySettings {
  float twig_radius = 0;  ///< turtle's units; > 0: radii by da Vinci's rule
  float flare = 0;        ///< widening of the foot of the stem, relative to its radius
  float sink = 0;         ///< how far the stem continues below the ground, turtle's units
  std::vector<std::string> colours{"bark"};  ///< materials of branches and polygons by colour
};

Description<GeometrySettings> describe(const GeometrySettings&);

struct BuildSettings {
  float foot_radius = 0;  ///< of the stem, turtle's units, for da Vinci's rule
  float height = 0;       ///< m, of the highest point; 0: as the turtle drew it
  float detail = 1;       ///< below 1 fewer sides and larger, fewer organs; above 1 rounder
  std::uint64_t seed = 0;
};

/// The mesh of a plant, parts sorted by material: colours first, then organs. Throws Error(input)
/// for an organ that is not described or a plant without height, Error(limit), Error(cancelled).
TriangleMesh build_mesh(Skeleton skeleton, const GeometrySettings& geometry,
                        const std::vector<Organ>& organs, const BuildSettings& settings,
                        Progress& progress);

}  // namespace wold
