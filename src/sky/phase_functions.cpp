#include "sky/phase_functions.hpp"

#include <algorithm>
#include <cmath>

namespace wold {

namespace {

/// x^1.5 of 1 + g² - 2 g cos θ, which is never below (1 - |g|)².
float power_3_2(float g, float cosine) {
  const float x = std::max(1 + g * g - 2 * g * cosine, 1e-12F);
  return x * std::sqrt(x);
}

}  // namespace

float isotropic_phase() {
  return 1 / (4 * pi);
}

float rayleigh_phase(float cosine) {
  return 3 / (16 * pi) * (1 + cosine * cosine);
}

float mie_phase(float cosine, float g) {
  return 3 / (8 * pi) * (1 - g * g) * (1 + cosine * cosine) / ((2 + g * g) * power_3_2(g, cosine));
}

float henyey_greenstein(float cosine, float g) {
  return (1 - g * g) / (4 * pi * power_3_2(g, cosine));
}

float double_henyey_greenstein(float cosine, float g1, float g2, float f) {
  return (1 - f) * henyey_greenstein(cosine, g1) + f * henyey_greenstein(cosine, g2);
}

float schlick_phase(float cosine, float k) {
  const float d = 1 - k * cosine;
  return (1 - k * k) / (4 * pi * d * d);
}

float schlick_k(float g) {
  return std::clamp(1.55F * g - 0.55F * g * g * g, -0.999F, 0.999F);
}

float sample_henyey_greenstein(float g, float u) {
  if (std::abs(g) < 1e-3F) return std::clamp(2 * u - 1 + 1.5F * g * 4 * u * (1 - u), -1.0F, 1.0F);
  const float q = (1 - g * g) / (1 - g + 2 * g * u);
  return std::clamp((1 + g * g - q * q) / (2 * g), -1.0F, 1.0F);
}

}  // namespace wold
