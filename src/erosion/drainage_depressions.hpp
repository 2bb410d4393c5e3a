#pragma once
// Ground without pits: depressions filled to where they spill, or breached by a notch through their
// lowest rim, so that water reaches the border from everywhere.
//
// Filling is the Priority-Flood (Barnes, Lehman, Mulla, "Priority-Flood: An optimal
// depression-filling and watershed-labeling algorithm for digital elevation models", 2014): ground
// is flooded from the border inwards, the lowest shore first,
//
//   level(n) = max(h(n), level(c))           flat: lakes are level
//   level(n) = max(h(n), next(level(c)))     sloping: next is the next larger float
//
// where c is the shore from which n is reached. Sloping leaves neither pits nor flats: every sample
// off the border has a lower neighbour. A raised sample waits in a queue of its own, in which
// levels only grow; the lower head of both queues comes next, so that no flood is out of order (the
// paper's variant with an epsilon takes the raised ones first and may lift ground above what is
// needed). Between equal levels on shores, the first by rows from the south-west comes first.
//
// Breaching is the least-cost path (Lindsay and Dhun, "Modelling surface drainage patterns in
// altered landscapes using LiDAR", 2015): from each pit, the lowest first, the way out to lower
// ground or to the border along which the least must be dug, where it is within the limits.

#include "base/grid.hpp"
#include "base/progress.hpp"

namespace wold {

enum class FillSurface { level, sloping };

/// The lowest ground that is nowhere below `height` and drains from everywhere. Of heights that are
/// finite numbers.
Grid<float> fill_depressions(const Grid<float>& height, FillSurface surface, Progress& progress);

/// Limits of a notch.
struct BreachLimits {
  double depth = 20;    ///< m, of a notch at any place
  double length = 500;  ///< m, in a straight line between its ends
};

/// Digs notches within the limits; depressions that need more stay.
Grid<float> breach_depressions(const Grid<float>& height, double cell, const BreachLimits& limits,
                               Progress& progress);

/// Samples off the border without a lower neighbour.
int count_pits(const Grid<float>& height);

}  // namespace wold
