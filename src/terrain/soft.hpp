#pragma once
// Soft versions of steps, minimum and maximum.

#include <algorithm>
#include <cmath>

namespace wold {

/// 0 below 0, 1 above 1, 3x² - 2x³ between.
inline float smoothstep(float x) {
  const float t = std::clamp(x, 0.0F, 1.0F);
  return t * t * (3 - 2 * t);
}

/// From 0 to 1 around `edge`, over `width`; a step where width is 0.
inline float soft_step(float edge, float width, float x) {
  if (width <= 0) return x >= edge ? 1.0F : 0.0F;
  return smoothstep((x - edge) / width + 0.5F);
}

/// The larger of two, rounded off where they differ by less than `softness` (by at most a quarter
/// of it): max(a, b) + max(0, s - |a - b|)² / 4s (Quilez, "Smooth minimum").
inline float soft_max(float a, float b, float softness) {
  if (softness <= 0) return std::max(a, b);
  const float overlap = std::max(0.0F, softness - std::abs(a - b));
  return std::max(a, b) + overlap * overlap / (4 * softness);
}

inline float soft_min(float a, float b, float softness) {
  return -soft_max(-a, -b, softness);
}

}  // namespace wold
