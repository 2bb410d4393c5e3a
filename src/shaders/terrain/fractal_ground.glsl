// The octaves of a fractal over the land (noise/fractal.hpp, terrain/fractal_ground.hpp). A value
// over the land is a vec3: the value, and its derivative by the place (east, north).

#include "noise/octaves.glsl"

// Zero that compilers do not see through: loops that begin with it stay loops.
#ifndef ZERO
#define ZERO 0
#endif

struct LandOctave {
  mat2 turn;        // from the fractal's place to the octave's
  float frequency;  // lattice units per unit of the fractal's place
  float amplitude;
};

LandOctave first_land_octave() {
  return LandOctave(mat2(0.8, 0.6, -0.6, 0.8), 1.0, 1.0);
}

LandOctave next_land_octave(LandOctave o, float lacunarity, float fall) {
  return LandOctave(lacunarity * (mat2(0.8, 0.6, -0.6, 0.8) * o.turn), o.frequency * lacunarity,
                    o.amplitude * fall);
}

// Gradient noise of an octave whose lattice begins at `cell`, moved by `shift` within it.
vec3 land_octave_noise(LandOctave o, vec2 p, ivec2 cell, vec2 shift, uint key) {
  vec2 q = o.turn * p + shift;
  vec2 below = floor(q);
  vec3 n = gradient_noise_in(uvec2(ivec2(below) + cell), q - below, key);
  return vec3(n.x, n.yz * o.turn);
}

vec3 product(vec3 a, vec3 b) {
  return vec3(a.x * b.x, a.x * b.yz + b.x * a.yz);
}

// |a|, or sqrt(a² + k²).
vec3 absolute(vec3 a, float k) {
  if (k == 0.0) return a.x < 0.0 ? -a : a;
  float root = sqrt(a.x * a.x + k * k);
  return vec3(root, a.yz * (a.x / root));
}

// s = (offset - |n|)² w; the next octave's w is gain s, held to [0, 1].
vec3 ridge(vec3 n, inout vec3 w, float offset, float gain, float k) {
  vec3 crest = vec3(offset, 0.0, 0.0) - absolute(n, k);
  vec3 s = product(product(crest, crest), w);
  w = gain * s;
  if (w.x < 0.0) w = vec3(0.0);
  if (w.x > 1.0) w = vec3(1.0, 0.0, 0.0);
  return s;
}

// w (n + offset) a, which is also the next octave's w, held to 1.
vec3 hybrid_term(vec3 n, inout vec3 w, float offset, float amplitude) {
  vec3 s = product(w, amplitude * (n + vec3(offset, 0.0, 0.0)));
  w = s.x > 1.0 ? vec3(1.0, 0.0, 0.0) : s;
  return s;
}
