#pragma once
// From where to where a slider of a parameter goes, and whether by ratio: a finite range for every
// parameter, also where any number is allowed.

#include "base/parameters.hpp"

namespace wold {

struct SliderRange {
  double low = 0;
  double high = 1;
  bool logarithmic = false;

  friend bool operator==(const SliderRange&, const SliderRange&) = default;
};

/// `usual` is the parameter's value in the scene or by default, by which an open range is chosen;
/// `present` lies within the result.
SliderRange slider_range(const Limits& limits, double usual, double present);

}  // namespace wold
