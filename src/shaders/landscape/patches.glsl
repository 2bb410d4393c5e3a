// Noise for colours and small shapes.
#include "noise/octaves.glsl"

#ifndef ZERO
#define ZERO 0
#endif

// Sum of octaves of gradient noise, in about [-1, 1]. Features of the first are `size` metres
// across; those finer than `footprint` are left out.
float patches(vec2 place, float size, float footprint, int octaves, uint seed) {
  vec2 p = place / size;
  float width = footprint / size;
  float sum = 0.0;
  float amplitude = 1.0;
  for (int i = ZERO; i < octaves; ++i) {
    float share = octave_weight(width);
    if (share <= 0.0) break;
    sum += amplitude * share * gradient_noise(p, seed + uint(i)).x;
    p = 2.03 * (mat2(0.8, 0.6, -0.6, 0.8) * p) + 17.3;
    width *= 2.03;
    amplitude *= 0.55;
  }
  return sum;
}

// With the derivative by the place.
vec3 patches_slope(vec2 place, float size, float footprint, int octaves, uint seed) {
  vec2 p = place / size;
  mat2 turn = mat2(1.0 / size);
  float width = footprint / size;
  vec3 sum = vec3(0.0);
  float amplitude = 1.0;
  for (int i = ZERO; i < octaves; ++i) {
    float share = octave_weight(width);
    if (share <= 0.0) break;
    vec3 n = gradient_noise(p, seed + uint(i));
    sum += amplitude * share * vec3(n.x, n.yz * turn);
    p = 2.03 * (mat2(0.8, 0.6, -0.6, 0.8) * p) + 17.3;
    turn = 2.03 * (mat2(0.8, 0.6, -0.6, 0.8) * turn);
    width *= 2.03;
    amplitude *= 0.5;
  }
  return sum;
}
