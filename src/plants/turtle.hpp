#pragma once
// The turtle: reads a word and draws branches, organs and polygons.
//
// State: position, heading H, left L, up U (a right-handed frame, H × L = U), radius, colour. It
// starts at the origin with H = +Z, L = -X, U = -Y: a stem whose plane of `+ -` faces south.
//
//   F(l)  forward by l, drawing      f(l)  forward without drawing     G(l)  as F, no vertex
//   +(a) -(a)  turn left, right about U          &(a) ^(a)  pitch down, up about L
//   \(a) /(a)  roll left, right about H          |  turn by 180° about U
//   $  roll so that L is horizontal              [ ]  remember and restore the state
//   !(r)  radius r; without argument r·`radius_factor`             '(n)  colour n; next colour
//   { . }  begin a polygon, record a vertex, end it (nested; F and f record one at their end)
//   ~X(s)  organ X in size s          %  skip the rest of the branch
//   @t(e)  bending by gravity e for what follows (negative: towards the light)
//
// Without an argument l is 1 and a is `angle`. Tropism: after each F of length l, the heading turns
// towards T by α = e |H × T| (ABOP, section 2.1), in radians, times l if `tropism_per_metre`.
// Other symbols do nothing.

#include <vector>

#include "base/parameters.hpp"
#include "base/vec.hpp"
#include "plants/lsystem.hpp"

namespace wold {

struct TurtleSettings {
  float angle = 90;            ///< degrees, for turns without an argument
  float step = 1;              ///< length of F without an argument
  float radius = 0.05F;        ///< radius at the start
  float radius_factor = 0.7F;  ///< of `!` without an argument
  Vec3 tropism{0, 0, -1};      ///< T, unit
  float bending = 0;           ///< e at the start
  bool tropism_per_metre = false;
};

Description<TurtleSettings> describe(const TurtleSettings&);

/// What the turtle drew, in its own units.
struct Skeleton {
  struct Node {
    Vec3 position{0};
    float radius = 0;
  };
  /// A branch: a chain of at least two nodes.
  struct Axis {
    int parent = -1;      ///< axis that carries it; -1 for a root
    int parent_node = 0;  ///< there
    int colour = 0;
    std::vector<Node> nodes;
  };
  struct OrganPlace {
    char name = 0;
    Vec3 position{0};
    Vec3 heading{0};
    Vec3 up{0};
    float size = 1;
  };
  struct Polygon {
    int colour = 0;
    std::vector<Vec3> vertices;
  };
  std::vector<Axis> axes;  ///< a parent comes before its children
  std::vector<OrganPlace> organs;
  std::vector<Polygon> polygons;
};

/// Reads the word. Throws Error(input) for brackets or braces without partner and for values that
/// are not finite.
Skeleton draw(const Word& word, const TurtleSettings& settings);

}  // namespace wold
