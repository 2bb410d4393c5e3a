// Twin of sky/phase_functions.hpp, where the formulas stand.

const float phase_pi = 3.14159265;

float isotropic_phase() {
  return 1.0 / (4.0 * phase_pi);
}

float rayleigh_phase(float cosine) {
  return 3.0 / (16.0 * phase_pi) * (1.0 + cosine * cosine);
}

// (1 + g² - 2g cos θ)^1.5
float phase_power(float cosine, float g) {
  float x = max(1.0 + g * g - 2.0 * g * cosine, 1e-12);
  return x * sqrt(x);
}

float mie_phase(float cosine, float g) {
  float scale = 3.0 / (8.0 * phase_pi) * (1.0 - g * g) / (2.0 + g * g);
  return scale * (1.0 + cosine * cosine) / phase_power(cosine, g);
}

float henyey_greenstein(float cosine, float g) {
  return (1.0 - g * g) / (4.0 * phase_pi * phase_power(cosine, g));
}

float double_henyey_greenstein(float cosine, float g1, float g2, float f) {
  return (1.0 - f) * henyey_greenstein(cosine, g1) + f * henyey_greenstein(cosine, g2);
}

float schlick_phase(float cosine, float k) {
  float d = 1.0 - k * cosine;
  return (1.0 - k * k) / (4.0 * phase_pi * d * d);
}

float schlick_k(float g) {
  return clamp(1.55 * g - 0.55 * g * g * g, -0.999, 0.999);
}
