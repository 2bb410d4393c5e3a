#pragma once
// Upstream area where water may divide among lower neighbours.
//
// D∞ (Tarboton, "A new method for the determination of flow directions and upslope areas in grid
// digital elevation models", 1997): of the 8 triangles between a sample and two successive
// neighbours the steepest is taken; its slope points in the direction
//
//   r = atan2(s2, s1),  s1 = (e0 - e1) / cell,  s2 = (e1 - e2) / cell
//
// where e0, e1, e2 are the heights of the sample, the neighbour along an axis and the one along the
// diagonal. Outside [0, 45°] it is held to the nearer edge. The two neighbours beside it get shares
// in proportion to how near they are in angle.
//
// Multiple flow (Freeman, "Calculating catchment area with divergent flow based on a regular grid",
// 1991): every lower neighbour gets a share in proportion to slope^p, slope = (e0 - e_n) / d_n.
// p = 1.1 spreads water on a cone most evenly; the larger, the nearer to D8.
//
// Water of a sample without lower neighbours ends there: out of the map on the border, in a pit
// elsewhere. Areas are in m².

#include "base/grid.hpp"
#include "base/progress.hpp"

namespace wold {

/// Directions of D∞ in units of 45°, 0 to 8, counter-clockwise from east; -1 where nothing is
/// lower.
Grid<float> d_infinity_directions(const Grid<float>& height, Progress& progress);

/// Upstream area of each sample with itself, m².
Grid<double> d_infinity_area(const Grid<float>& height, double cell, Progress& progress);

/// The same by multiple flow with exponent p.
Grid<double> multiple_flow_area(const Grid<float>& height, double cell, double exponent,
                                Progress& progress);

}  // namespace wold
