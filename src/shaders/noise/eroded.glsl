// The eroded fractal with its derivative, twin of add_eroded_octaves in noise/fractal.cpp: with
// d = Σ b_i ∇n_i, D its derivative (symmetric) and t = a n / q, q = 1 + c |d|²,
// ∇t = (a ∇n - t 2c D d) / q.
#include "noise/noise_curvature.glsl"
#include "noise/octaves.glsl"

vec3 eroded(LatticePlace2 p, Fractal f, uint seed, int octaves, float spacing) {
  Octaves2 o = first_octave(p, f, seed);
  vec2 d = vec2(0.0);
  mat2 second = mat2(0.0);
  vec3 total = vec3(0.0);
  for (int i = 0; i < octaves; ++i) {
    float weight = octave_weight(spacing * o.frequency);
    if (weight <= 0.0) break;
    uvec2 cell = lattice_cell(o.place);
    vec2 t = cell_fraction(o.place);
    uint key = octave_key(o.seed, o.index);
    Curvature2 n;
    if (f.basis == noise_basis_gradient) n = gradient_curvature_in(cell, t, key);
    else n = value_curvature_in(cell, t, key);
    mat2 m = mat2(o.turn, vec2(-o.turn.y, o.turn.x));
    float a = o.amplitude * weight;
    vec2 slope = a * (n.slope * m);
    d += slope;
    second += a * (transpose(m) * n.second * m);
    float damped = 1.0 / (1.0 + f.damping * dot(d, d));
    float term = a * n.value * damped;
    total += vec3(term, (slope - 2.0 * f.damping * term * (second * d)) * damped);
    to_next(o);
  }
  return total;
}

vec4 eroded(LatticePlace3 p, Fractal f, uint seed, int octaves, float spacing) {
  Octaves3 o = first_octave(p, f, seed);
  vec3 d = vec3(0.0);
  mat3 second = mat3(0.0);
  vec4 total = vec4(0.0);
  for (int i = 0; i < octaves; ++i) {
    float weight = octave_weight(spacing * o.frequency);
    if (weight <= 0.0) break;
    uvec3 cell = lattice_cell(o.place);
    vec3 t = cell_fraction(o.place);
    uint key = octave_key(o.seed, o.index);
    Curvature3 n;
    if (f.basis == noise_basis_gradient) n = gradient_curvature_in(cell, t, key);
    else n = value_curvature_in(cell, t, key);
    mat3 m = o.matrix;
    float a = o.amplitude * weight;
    vec3 slope = a * (n.slope * m);
    d += slope;
    second += a * (transpose(m) * n.second * m);
    float damped = 1.0 / (1.0 + f.damping * dot(d, d));
    float term = a * n.value * damped;
    total += vec4(term, (slope - 2.0 * f.damping * term * (second * d)) * damped);
    to_next(o);
  }
  return total;
}

vec3 eroded(vec2 p, Fractal f, uint seed, int octaves, float spacing) {
  return eroded(lattice_place(p), f, seed, octaves, spacing);
}
vec4 eroded(vec3 p, Fractal f, uint seed, int octaves, float spacing) {
  return eroded(lattice_place(p), f, seed, octaves, spacing);
}
