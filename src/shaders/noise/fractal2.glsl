// Twin of noise/fractal.hpp in the plane: one function for each kind, as value alone and with the
// derivative by p (value, d/dx, d/dy). `octaves` takes the place of f.octaves; f.kind is not
// read. The derivative of `eroded`, which needs second ones of the noise, is in eroded.glsl.
#include "noise/octaves.glsl"
#include "noise/quick_octaves.glsl"

// Values with derivatives: a constant, a product, |a| (with its edge rounded by k).
vec3 constant_sample2(float a) {
  return vec3(a, vec2(0.0));
}
vec3 sample_product(vec3 a, vec3 b) {
  return vec3(a.x * b.x, a.x * b.yz + b.x * a.yz);
}
vec3 sample_absolute(vec3 a, float k) {
  if (k == 0.0) return a.x < 0.0 ? -a : a;
  float root = sqrt(a.x * a.x + k * k);
  return vec3(root, a.yz * (a.x / root));
}

float fbm_value(LatticePlace2 p, Fractal f, uint seed, int octaves, float spacing) {
  ValueOctaves2 o = first_value_octave(p, f, seed);
  float total = 0.0;
  for (int i = 0; i < octaves; ++i) {
    float weight = octave_weight(spacing * o.frequency);
    if (weight <= 0.0) break;
    total += o.amplitude * weight * octave_value(o, f.basis);
    to_next(o);
  }
  return total;
}

float turbulence_value(LatticePlace2 p, Fractal f, uint seed, int octaves, float spacing) {
  ValueOctaves2 o = first_value_octave(p, f, seed);
  float total = 0.0;
  for (int i = 0; i < octaves; ++i) {
    float weight = octave_weight(spacing * o.frequency);
    if (weight <= 0.0) break;
    total += o.amplitude * weight * abs(octave_value(o, f.basis));
    to_next(o);
  }
  return total;
}

float hybrid_value(LatticePlace2 p, Fractal f, uint seed, int octaves, float spacing) {
  ValueOctaves2 o = first_value_octave(p, f, seed);
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

float ridged_value(LatticePlace2 p, Fractal f, uint seed, int octaves, float spacing) {
  ValueOctaves2 o = first_value_octave(p, f, seed);
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

float eroded_value(LatticePlace2 p, Fractal f, uint seed, int octaves, float spacing) {
  Octaves2 o = first_octave(p, f, seed);
  float total = 0.0;
  vec2 slope = vec2(0.0);
  for (int i = 0; i < octaves; ++i) {
    float weight = octave_weight(spacing * o.frequency);
    if (weight <= 0.0) break;
    vec3 n = octave_noise(o, f.basis) * (o.amplitude * weight);
    slope += n.yz;
    total += n.x / (1.0 + f.damping * dot(slope, slope));
    to_next(o);
  }
  return total;
}

vec3 fbm(LatticePlace2 p, Fractal f, uint seed, int octaves, float spacing) {
  Octaves2 o = first_octave(p, f, seed);
  vec3 total = vec3(0.0);
  for (int i = 0; i < octaves; ++i) {
    float weight = octave_weight(spacing * o.frequency);
    if (weight <= 0.0) break;
    total += o.amplitude * weight * octave_noise(o, f.basis);
    to_next(o);
  }
  return total;
}

vec3 turbulence(LatticePlace2 p, Fractal f, uint seed, int octaves, float spacing) {
  Octaves2 o = first_octave(p, f, seed);
  vec3 total = vec3(0.0);
  for (int i = 0; i < octaves; ++i) {
    float weight = octave_weight(spacing * o.frequency);
    if (weight <= 0.0) break;
    vec3 n = octave_noise(o, f.basis) * (o.amplitude * weight);
    total += n.x < 0.0 ? -n : n;
    to_next(o);
  }
  return total;
}

vec3 hybrid(LatticePlace2 p, Fractal f, uint seed, int octaves, float spacing) {
  Octaves2 o = first_octave(p, f, seed);
  vec3 total = vec3(0.0);
  vec3 w = constant_sample2(1.0);
  for (int i = 0; i < octaves; ++i) {
    float weight = octave_weight(spacing * o.frequency);
    if (weight <= 0.0) break;
    vec3 n = octave_noise(o, f.basis) + constant_sample2(f.offset);
    w = sample_product(w, o.amplitude * n);
    total += w * weight;
    if (w.x > 1.0) w = constant_sample2(1.0);
    to_next(o);
  }
  return total;
}

vec3 ridged(LatticePlace2 p, Fractal f, uint seed, int octaves, float spacing) {
  Octaves2 o = first_octave(p, f, seed);
  vec3 total = vec3(0.0);
  vec3 w = constant_sample2(1.0);
  for (int i = 0; i < octaves; ++i) {
    float weight = octave_weight(spacing * o.frequency);
    if (weight <= 0.0) break;
    vec3 n = octave_noise(o, f.basis);
    vec3 crest = constant_sample2(f.offset) - sample_absolute(n, f.smooth_ridges);
    vec3 s = sample_product(sample_product(crest, crest), w);
    total += s * (o.amplitude * weight);
    w = s * f.gain;
    if (w.x < 0.0 || w.x > 1.0) w = constant_sample2(clamp(w.x, 0.0, 1.0));
    to_next(o);
  }
  return total;
}

// At a position in lattice units.
float fbm_value(vec2 p, Fractal f, uint seed, int octaves, float spacing) {
  return fbm_value(lattice_place(p), f, seed, octaves, spacing);
}
float turbulence_value(vec2 p, Fractal f, uint seed, int octaves, float spacing) {
  return turbulence_value(lattice_place(p), f, seed, octaves, spacing);
}
float hybrid_value(vec2 p, Fractal f, uint seed, int octaves, float spacing) {
  return hybrid_value(lattice_place(p), f, seed, octaves, spacing);
}
float ridged_value(vec2 p, Fractal f, uint seed, int octaves, float spacing) {
  return ridged_value(lattice_place(p), f, seed, octaves, spacing);
}
float eroded_value(vec2 p, Fractal f, uint seed, int octaves, float spacing) {
  return eroded_value(lattice_place(p), f, seed, octaves, spacing);
}
vec3 fbm(vec2 p, Fractal f, uint seed, int octaves, float spacing) {
  return fbm(lattice_place(p), f, seed, octaves, spacing);
}
vec3 turbulence(vec2 p, Fractal f, uint seed, int octaves, float spacing) {
  return turbulence(lattice_place(p), f, seed, octaves, spacing);
}
vec3 hybrid(vec2 p, Fractal f, uint seed, int octaves, float spacing) {
  return hybrid(lattice_place(p), f, seed, octaves, spacing);
}
vec3 ridged(vec2 p, Fractal f, uint seed, int octaves, float spacing) {
  return ridged(lattice_place(p), f, seed, octaves, spacing);
}
