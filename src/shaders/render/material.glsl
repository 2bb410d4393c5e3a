// Twin of render/material.hpp: two colours mixed by noise, and the differences between individuals
// and between leaves. 64-bit numbers are uvec2(low, high), as in base/hash.hpp.
#include "noise/fractal3.glsl"
#include "render/two_colors.glsl"

uvec2 product64(uint a, uint b) {
  uint a0 = a & 0xffffu;
  uint a1 = a >> 16u;
  uint b0 = b & 0xffffu;
  uint b1 = b >> 16u;
  uint low = a0 * b0;
  uint middle = a1 * b0 + (low >> 16u);
  uint other = a0 * b1 + (middle & 0xffffu);
  return uvec2((other << 16u) | (low & 0xffffu), a1 * b1 + (middle >> 16u) + (other >> 16u));
}
uvec2 product64(uvec2 a, uvec2 b) {
  uvec2 p = product64(a.x, b.x);
  p.y += a.x * b.y + a.y * b.x;
  return p;
}
uvec2 sum64(uvec2 a, uvec2 b) {
  uint low = a.x + b.x;
  return uvec2(low, a.y + b.y + (low < a.x ? 1u : 0u));
}
// x ^ (x >> n), n < 32.
uvec2 shifted_xor64(uvec2 x, uint n) {
  return uvec2(x.x ^ ((x.x >> n) | (x.y << (32u - n))), x.y ^ (x.y >> n));
}

uvec2 mix_bits64(uvec2 x) {
  x = product64(shifted_xor64(x, 30u), uvec2(0x1ce4e5b9u, 0xbf58476du));
  x = product64(shifted_xor64(x, 27u), uvec2(0x133111ebu, 0x94d049bbu));
  return shifted_xor64(x, 31u);
}

const uvec2 golden_ratio64 = uvec2(0x7f4a7c15u, 0x9e3779b9u);

uvec2 random_bits(uvec2 seed, uint part) {
  uvec2 h = mix_bits64(sum64(seed, golden_ratio64));
  h.x ^= part;
  return mix_bits64(sum64(product64(h, uvec2(5u, 0u)), golden_ratio64));
}

float uniform_of(uvec2 bits) {
  return float(bits.y >> 8u) * 5.9604644775390625e-8;
}

// Brightness and a shift between yellow and blue-green, each about 1.
vec3 material_tint(vec2 uniforms, float amount) {
  float brightness = 1.0 + amount * (2.0 * uniforms.x - 1.0);
  float warmth = amount * (2.0 * uniforms.y - 1.0);
  return brightness * vec3(1.0 + 0.9 * warmth, 1.0, 1.0 - 0.5 * warmth);
}
vec3 material_tint(uvec2 bits, float amount) {
  return material_tint(vec2(uniform_of(bits), uniform_of(mix_bits64(bits))), amount);
}

struct TwoColors {
  vec3 color1;
  vec3 color2;
  float feature_size;  // m
  float contrast;
  float stretch;
  uint seed;
};

vec3 two_colors(TwoColors t, vec3 p, float footprint) {
  vec3 scaled = vec3(p.xy, p.z / t.stretch) / t.feature_size;
  Fractal f = Fractal(fractal_fbm, noise_basis_gradient, 5, 2.0, 0.7, 1.0, 2.0, 0.0, 1.0);
  float n = fbm_value(lattice_place(scaled), f, t.seed, 5, footprint / t.feature_size);
  return mix_two_colors(t.color1, t.color2, t.contrast, n);
}

// At most 95 % of what comes goes on.
void keep_energy(inout vec3 reflectance, inout vec3 transmittance) {
  vec3 sum = reflectance + transmittance;
  float most = max(sum.x, max(sum.y, sum.z));
  float share = most > 0.95 ? 0.95 / most : 1.0;
  reflectance *= share;
  transmittance *= share;
}
