#pragma once
// Brings to rest what still slides after the passes of thermal_slide.hpp, in one go.
//
// Long slopes near their angle of repose pass on what comes from above for thousands of passes.
// Here instead:
// 1. Loose material is cut down to the highest surface h' ≤ h on which no loose sample is higher
//    above any of its eight neighbours than the angle of repose plus the tolerance allows:
//    h'(x) = max(bed(x), min(h(x), min over neighbours y of h'(y) + tan(R + tolerance) |x - y|)).
// 2. What was cut runs down, from the highest sample to the lowest, shared among all lower
//    neighbours in proportion to the slopes towards them. On its way it fills what lies lower than
//    the mean of its neighbours, and a film more, as far as there is room below the angle of repose
//    less two tolerances. The rest runs on to samples that are lower by then, so it ends.
//
// Rising ground only becomes steeper towards what lies lower, which the room allows for: so what
// holds after the first step holds after the second. Whole numbers: nothing is lost.

#include "erosion/thermal_slide.hpp"

namespace wold {

/// Afterwards no sample that holds loose material is steeper towards any of its eight neighbours
/// than the angle of repose plus the tolerance, and no rock has broken. Throws Error(cancelled).
void bring_to_rest(SlideGround& ground, const SlideRules& rules, Progress& progress);

}  // namespace wold
