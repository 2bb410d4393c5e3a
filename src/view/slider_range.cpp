#include "view/slider_range.hpp"

#include <algorithm>
#include <cmath>

namespace wold {

namespace {

constexpr double decades = 100;    // of a range, from here on by ratio
constexpr double vast = 1000;      // a limit so many times the usual value is no range to slide in
constexpr double open_factor = 4;  // of an open range, linear
constexpr double ratio_factor = 50;  // of an open range, by ratio

double end_for(const Limits& limits, double usual) {
  const double size = std::abs(usual);
  if (size > 0) return size * open_factor;
  if (limits.unit == "degrees") return 90;
  return limits.unit == "m" ? 100 : 1;
}

}  // namespace

SliderRange slider_range(const Limits& limits, double usual, double present) {
  const double size = std::abs(usual);
  const bool has_low = std::isfinite(limits.min) && (size == 0 || -limits.min <= vast * size);
  const bool has_high = std::isfinite(limits.max) && (size == 0 || limits.max <= vast * size);
  SliderRange range;
  const bool positive = limits.min > 0 && usual > 0;
  if (positive && (!has_high || limits.max / limits.min >= decades)) {
    range.logarithmic = true;
    range.low = std::max(limits.min, usual / ratio_factor);
    range.high = std::min(limits.max, usual * ratio_factor);
  } else {
    const double end = end_for(limits, usual);
    range.high = has_high ? limits.max : end;
    range.low = has_low ? limits.min : std::max(limits.min, -end);
    if (!has_high && has_low) range.high = std::max(end, limits.min + end);
    range.high = std::min(range.high, limits.max);
    range.logarithmic = range.low >= 0 && usual > 0 && range.high >= decades * usual;
  }
  range.low = std::min(range.low, present);
  range.high = std::max(range.high, present);
  if (!(range.high > range.low)) range.high = range.low + 1;
  return range;
}

}  // namespace wold
