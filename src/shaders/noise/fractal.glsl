// Twin of noise/fractal.hpp: the fractal of any kind. `fractal` gives value and derivative by p,
// `fractal_value` the value alone, at a place of lattice_place or a position in lattice units.
// `spacing` is the distance between samples in the same units; 0 keeps all octaves.
//
// With f of constants only the code of its kind is left; shaders that know the kind can include
// noise/fractal2.glsl or noise/fractal3.glsl, which are shorter, and call it by name.
#include "noise/fractal2.glsl"
#include "noise/fractal3.glsl"
#include "noise/eroded.glsl"

vec3 fractal(LatticePlace2 p, Fractal f, uint seed, float spacing) {
  if (f.kind == fractal_fbm) return fbm(p, f, seed, f.octaves, spacing);
  if (f.kind == fractal_hybrid) return hybrid(p, f, seed, f.octaves, spacing);
  if (f.kind == fractal_ridged) return ridged(p, f, seed, f.octaves, spacing);
  if (f.kind == fractal_turbulence) return turbulence(p, f, seed, f.octaves, spacing);
  return eroded(p, f, seed, f.octaves, spacing);
}
vec3 fractal(vec2 p, Fractal f, uint seed, float spacing) {
  return fractal(lattice_place(p), f, seed, spacing);
}

vec4 fractal(LatticePlace3 p, Fractal f, uint seed, float spacing) {
  if (f.kind == fractal_fbm) return fbm(p, f, seed, f.octaves, spacing);
  if (f.kind == fractal_hybrid) return hybrid(p, f, seed, f.octaves, spacing);
  if (f.kind == fractal_ridged) return ridged(p, f, seed, f.octaves, spacing);
  if (f.kind == fractal_turbulence) return turbulence(p, f, seed, f.octaves, spacing);
  return eroded(p, f, seed, f.octaves, spacing);
}
vec4 fractal(vec3 p, Fractal f, uint seed, float spacing) {
  return fractal(lattice_place(p), f, seed, spacing);
}

float fractal_value(LatticePlace2 p, Fractal f, uint seed, float spacing) {
  if (f.kind == fractal_fbm) return fbm_value(p, f, seed, f.octaves, spacing);
  if (f.kind == fractal_hybrid) return hybrid_value(p, f, seed, f.octaves, spacing);
  if (f.kind == fractal_ridged) return ridged_value(p, f, seed, f.octaves, spacing);
  if (f.kind == fractal_turbulence) return turbulence_value(p, f, seed, f.octaves, spacing);
  return eroded_value(p, f, seed, f.octaves, spacing);
}
float fractal_value(vec2 p, Fractal f, uint seed, float spacing) {
  return fractal_value(lattice_place(p), f, seed, spacing);
}

float fractal_value(LatticePlace3 p, Fractal f, uint seed, float spacing) {
  if (f.kind == fractal_fbm) return fbm_value(p, f, seed, f.octaves, spacing);
  if (f.kind == fractal_hybrid) return hybrid_value(p, f, seed, f.octaves, spacing);
  if (f.kind == fractal_ridged) return ridged_value(p, f, seed, f.octaves, spacing);
  if (f.kind == fractal_turbulence) return turbulence_value(p, f, seed, f.octaves, spacing);
  return eroded_value(p, f, seed, f.octaves, spacing);
}
float fractal_value(vec3 p, Fractal f, uint seed, float spacing) {
  return fractal_value(lattice_place(p), f, seed, spacing);
}
