// Twin of noise/fractal.hpp in space: one function for each kind, as value alone and with the
// derivative by p (value, d/dx, d/dy, d/dz). `octaves` takes the place of f.octaves; f.kind is not
// read. The derivative of `eroded`, which needs second ones of the noise, is in eroded.glsl.
#include "noise/octaves.glsl"
#include "noise/quick_octaves.glsl"

// Values with derivatives: a constant, a product, |a| (with its edge rounded by k).
vec4 constant_sample3(float a) {
  return vec4(a, vec3(0.0));
}
vec4 sample_product(vec4 a, vec4 b) {
  return vec4(a.x * b.x, a.x * b.yzw + b.x * a.yzw);
}
vec4 sample_absolute(vec4 a, float k) {
  if (k == 0.0) return a.x < 0.0 ? -a : a;
  float root = sqrt(a.x * a.x + k * k);
  return vec4(root, a.yzw * (a.x / root));
}

float fbm_value(LatticePlace3 p, Fractal f, uint seed, int octaves, float spacing) {
  ValueOctaves3 o = first_value_octave(p, f, seed);
  float total = 0.0;
  for (int i = 0; i < octaves; ++i) {
    float weight = octave_weight(spacing * o.frequency);
    if (weight <= 0.0) break;
    total += o.amplitude * weight * octave_value(o, f.basis);
    to_next(o);
  }
  return total;
}

float turbulence_value(LatticePlace3 p, Fractal f, uint seed, int octaves, float spacing) {
  ValueOctaves3 o = first_value_octave(p, f, seed);
  float total = 0.0;
  for (int i = 0; i < octaves; ++i) {
    float weight = octave_weight(spacing * o.frequency);
    if (weight <= 0.0) break;
    total += o.amplitude * weight * abs(octave_value(o, f.basis));
    to_next(o);
  }
  return total;
}

float hybrid_value(LatticePlace3 p, Fractal f, uint seed, int octaves, float spacing) {
  ValueOctaves3 o = first_value_octave(p, f, seed);
  float total = 0.0;
  float w = 1.0;
  for (int i = 0; i < octaves; ++i) {
    float weight = octave_weight(spacing * o.frequency);
    if (weight <= 0.0) break;
    w *= o.amplitude * (octave_value(o, f.basis) + f.offset);
    total += w * weight;
    w = min(w, 1.0);
    to_next(o);
  }
  return total;
}

float ridged_value(LatticePlace3 p, Fractal f, uint seed, int octaves, float spacing) {
  ValueOctaves3 o = first_value_octave(p, f, seed);
  float total = 0.0;
  float w = 1.0;
  for (int i = 0; i < octaves; ++i) {
    float weight = octave_weight(spacing * o.frequency);
    if (weight <= 0.0) break;
    float n = octave_value(o, f.basis);
    float crest = f.offset - sqrt(n * n + f.smooth_ridges * f.smooth_ridges);
    float s = crest * crest * w;
    total += s * o.amplitude * weight;
    w = clamp(f.gain * s, 0.0, 1.0);
    to_next(o);
  }
  return total;
}

float eroded_value(LatticePlace3 p, Fractal f, uint seed, int octaves, float spacing) {
  Octaves3 o = first_octave(p, f, seed);
  float total = 0.0;
  vec3 slope = vec3(0.0);
  for (int i = 0; i < octaves; ++i) {
    float weight = octave_weight(spacing * o.frequency);
    if (weight <= 0.0) break;
    vec4 n = octave_noise(o, f.basis) * (o.amplitude * weight);
    slope += n.yzw;
    total += n.x / (1.0 + f.damping * dot(slope, slope));
    to_next(o);
  }
  return total;
}

vec4 fbm(LatticePlace3 p, Fractal f, uint seed, int octaves, float spacing) {
  Octaves3 o = first_octave(p, f, seed);
  vec4 total = vec4(0.0);
  for (int i = 0; i < octaves; ++i) {
    float weight = octave_weight(spacing * o.frequency);
    if (weight <= 0.0) break;
    total += o.amplitude * weight * octave_noise(o, f.basis);
    to_next(o);
  }
  return total;
}

vec4 turbulence(LatticePlace3 p, Fractal f, uint seed, int octaves, float spacing) {
  Octaves3 o = first_octave(p, f, seed);
  vec4 total = vec4(0.0);
  for (int i = 0; i < octaves; ++i) {
    float weight = octave_weight(spacing * o.frequency);
    if (weight <= 0.0) break;
    vec4 n = octave_noise(o, f.basis) * (o.amplitude * weight);
    total += n.x < 0.0 ? -n : n;
    to_next(o);
  }
  return total;
}

vec4 hybrid(LatticePlace3 p, Fractal f, uint seed, int octaves, float spacing) {
  Octaves3 o = first_octave(p, f, seed);
  vec4 total = vec4(0.0);
  vec4 w = constant_sample3(1.0);
  for (int i = 0; i < octaves; ++i) {
    float weight = octave_weight(spacing * o.frequency);
    if (weight <= 0.0) break;
    vec4 n = octave_noise(o, f.basis) + constant_sample3(f.offset);
    w = sample_product(w, o.amplitude * n);
    total += w * weight;
    if (w.x > 1.0) w = constant_sample3(1.0);
    to_next(o);
  }
  return total;
}

vec4 ridged(LatticePlace3 p, Fractal f, uint seed, int octaves, float spacing) {
  Octaves3 o = first_octave(p, f, seed);
  vec4 total = vec4(0.0);
  vec4 w = constant_sample3(1.0);
  for (int i = 0; i < octaves; ++i) {
    float weight = octave_weight(spacing * o.frequency);
    if (weight <= 0.0) break;
    vec4 n = octave_noise(o, f.basis);
    vec4 crest = constant_sample3(f.offset) - sample_absolute(n, f.smooth_ridges);
    vec4 s = sample_product(sample_product(crest, crest), w);
    total += s * (o.amplitude * weight);
    w = s * f.gain;
    if (w.x < 0.0 || w.x > 1.0) w = constant_sample3(clamp(w.x, 0.0, 1.0));
    to_next(o);
  }
  return total;
}

// At a position in lattice units.
float fbm_value(vec3 p, Fractal f, uint seed, int octaves, float spacing) {
  return fbm_value(lattice_place(p), f, seed, octaves, spacing);
}
float turbulence_value(vec3 p, Fractal f, uint seed, int octaves, float spacing) {
  return turbulence_value(lattice_place(p), f, seed, octaves, spacing);
}
float hybrid_value(vec3 p, Fractal f, uint seed, int octaves, float spacing) {
  return hybrid_value(lattice_place(p), f, seed, octaves, spacing);
}
float ridged_value(vec3 p, Fractal f, uint seed, int octaves, float spacing) {
  return ridged_value(lattice_place(p), f, seed, octaves, spacing);
}
float eroded_value(vec3 p, Fractal f, uint seed, int octaves, float spacing) {
  return eroded_value(lattice_place(p), f, seed, octaves, spacing);
}
vec4 fbm(vec3 p, Fractal f, uint seed, int octaves, float spacing) {
  return fbm(lattice_place(p), f, seed, octaves, spacing);
}
vec4 turbulence(vec3 p, Fractal f, uint seed, int octaves, float spacing) {
  return turbulence(lattice_place(p), f, seed, octaves, spacing);
}
vec4 hybrid(vec3 p, Fractal f, uint seed, int octaves, float spacing) {
  return hybrid(lattice_place(p), f, seed, octaves, spacing);
}
vec4 ridged(vec3 p, Fractal f, uint seed, int octaves, float spacing) {
  return ridged(lattice_place(p), f, seed, octaves, spacing);
}
