#pragma once
// The rungs of the ladder of thermal_slide.hpp: ground on cells twice as large, and its change laid
// back over the finer. Whole numbers throughout: what one cell gets another gives.

#include "erosion/thermal_slide.hpp"

namespace wold {

/// Whether cells twice as large are worth their work.
bool has_coarser_rung(const SlideGround& ground);

/// Means of 2 x 2 cells; a last odd row or column has none. Hardness: the greatest near.
SlideGround coarser_rung(const SlideGround& ground);

/// Adds what changed from `before` to `after` to the finer ground, smoothly: what a coarse cell
/// gained its four cells gain, then a quarter of the difference goes between neighbours of
/// different coarse cells. Loose material that left is taken from each cell in proportion to what
/// it holds.
void lay_over(SlideGround& fine, const SlideGround& before, const SlideGround& after);

}  // namespace wold
