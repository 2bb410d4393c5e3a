#pragma once
// What a skeleton needs before it gets a surface: axes that go on through forks, and radii.

#include <vector>

#include "plants/turtle.hpp"

namespace wold {

/// Where an axis ends in a fork, its strongest branch of the same colour becomes its continuation
/// (of equal ones, the straightest), so that a stem is one smooth surface. `by_radius`: strength is
/// the radius; otherwise how much the branch carries.
void continue_axes(Skeleton& skeleton, bool by_radius);

/// Radii by da Vinci's rule, r^e = Σ r_i^e: r = twig (n / 1)^(1/e), where n counts the tips beyond
/// a node, and a share for the length of wood, so that an unbranched axis tapers too; e is the
/// exponent that gives `foot` at the foot, at least 1.
void set_radii(Skeleton& skeleton, float twig, float foot);

}  // namespace wold
