#pragma once
// The trees of a scene as a landscape shader shows them: pointed crowns and round ones.

#include "base/progress.hpp"
#include "scene/scene.hpp"

namespace wold {

struct CrownKind {
  float share = 0;           ///< of all trees
  Range height{9, 19};       ///< m
  float slenderness = 0.2F;  ///< crown's radius over the tree's height
};

struct WoodKinds {
  CrownKind pointed{0.5F, {10, 19}, 0.17F};
  CrownKind round{0.5F, {10, 15}, 0.26F};
};

/// From a grown model of each species that a scatter names and that is a tree, by how densely they
/// stand. Without trees, what stands there by default. Throws as grow_species; Error(io) for plant
/// files that are not there.
WoodKinds wood_kinds(const Scene& scene, Progress& progress);

/// By the distance from the stem that 9 of 10 vertices keep: that in the uppermost sixth of the
/// height over that in the widest (a cone: about 0.15, half a ball: 0.5), and that of all over the
/// height.
struct CrownShape {
  float taper = 1;
  float slenderness = 0.2F;
};
CrownShape crown_shape(const TriangleMesh& mesh);

}  // namespace wold
