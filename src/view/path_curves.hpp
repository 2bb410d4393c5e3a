#pragma once
// The curves of camera paths, through values at rising times. Before the first and after the last
// time they stay as there.

#include <span>

#include "base/vec.hpp"

namespace wold {

/// A monotone cubic: between two values it never leaves them (Fritsch and Carlson 1980, with the
/// weighted harmonic mean of Fritsch and Butland 1984 as slope).
double monotone_at(std::span<const double> times, std::span<const double> values, double time);

/// A centripetal Catmull-Rom spline, along which the camera moves monotonically.
DVec3 spline_at(std::span<const double> times, std::span<const DVec3> points, double time);

/// The same kind of curve over the sphere, of unit vectors, with the times as knots.
DVec3 sphere_curve_at(std::span<const double> times, std::span<const DVec3> directions,
                      double time);

/// The direction a part s of the arc from a to b; s beyond 0 and 1 goes on along the circle.
DVec3 arc(const DVec3& a, const DVec3& b, double s);

}  // namespace wold
