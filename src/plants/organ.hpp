#pragma once
// Organs: what `~X` puts at the end of a twig. Small polygon meshes made from a few numbers.
//
// An organ lies along the heading, its upper side towards up. `leaf` is a blade with an outline, a
// fold along the midrib and a bend along its length; `shoot` is a twig with needles, each needle
// (or bundle) one triangle; `disc` a round flower head or berry.

#include <string>
#include <vector>

#include "base/mesh.hpp"
#include "base/parameters.hpp"

namespace wold {

enum class OrganShape { leaf, shoot, disc };

struct Organ {
  char name = 0;  ///< X of `~X`
  OrganShape shape = OrganShape::leaf;
  std::string material = "leaf";
  float length = 1;            ///< in the turtle's units, times the size given with `~X(size)`
  float width = 0.5F;          ///< relative to length (of a needle: of a shoot)
  float widest = 0.4F;         ///< where a blade is widest, from its base, relative to length
  float stalk = 0;             ///< bare part before the blade, relative to length
  float fold = 0;              ///< degrees between each half and the flat blade
  float bend = 0;              ///< degrees by which the tip turns down
  int segments = 2;            ///< along the blade
  int needles = 12;            ///< of a shoot
  float needle_length = 0.2F;  ///< relative to the shoot's length
  float needle_angle = 50;     ///< degrees between needle and shoot
};

Description<Organ> describe(const Organ&);

/// The mesh of an organ at the origin: heading +X, left +Y, up +Z. One part.
TriangleMesh organ_mesh(const Organ& organ);

}  // namespace wold
