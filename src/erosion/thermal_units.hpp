#pragma once
// Heights in metres as whole units of thermal_slide.hpp, and back.

#include "erosion/thermal_slide.hpp"
#include "terrain/heightfield.hpp"

namespace wold {

struct SlideUnits {
  double base = 0;  ///< m, at 0 units
  double unit = 1;  ///< m, a power of 2
};

/// For heights from the lowest of the ground less `below` to its highest plus `above`, m.
SlideUnits slide_units(const Heightfield& ground, double below, double above);

Grid<std::int32_t> in_units(const Grid<float>& height, const SlideUnits& units);

/// Heights changed by what changed in units; where nothing did they stay as they are. What
/// rounding to floats leaves in one sample goes into the next that changed: sums are kept.
Grid<float> changed_heights(const Grid<float>& height, const Grid<std::int32_t>& before,
                            const Grid<std::int32_t>& after, double unit);

/// `scale` (a - b) where that is positive, else 0.
Grid<float> positive_difference(const Grid<std::int32_t>& a, const Grid<std::int32_t>& b,
                                double scale);

}  // namespace wold
