#pragma once
// The sRGB transfer function (IEC 61966-2-1), between linear light and what picture files store.
//
//   linear = c / 12.92 for c <= 0.04045, else ((c + 0.055) / 1.055)^2.4

#include <cmath>

#include "base/vec.hpp"

namespace wold {

/// From a stored value to linear light. Odd: negative values keep their sign.
inline float srgb_to_linear(float c) {
  const float a = std::abs(c);
  return std::copysign(a <= 0.04045F ? a / 12.92F : std::pow((a + 0.055F) / 1.055F, 2.4F), c);
}

/// From linear light to a stored value; the inverse of `srgb_to_linear`.
inline float linear_to_srgb(float c) {
  const float a = std::abs(c);
  return std::copysign(
      a <= 0.04045F / 12.92F ? a * 12.92F : 1.055F * std::pow(a, 1.0F / 2.4F) - 0.055F, c);
}

/// Luminance of a linear Rec. 709 colour.
inline float luminance(Vec3 c) {
  return 0.2126F * c.x + 0.7152F * c.y + 0.0722F * c.z;
}

}  // namespace wold
