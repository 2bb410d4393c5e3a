// What all fractals share (noise/fractal.hpp): their parameters, and the walk from octave to
// octave.
//
// Octave i looks at p_i, p_{i+1} = lacunarity · R p_i + d. Its place in the lattice cell must be
// right to 1e-7 though p_i is in the thousands, and in `float` an error at the start would grow
// with each octave too. So places are fixed-point numbers, whole units of 1/4096 of a cell, and a
// rest below one unit in `float`. The matrix is split as well, M = high / 2^20 + low:
//
//   M grid = q + (high · grid - 2^20 q) / 2^20 + low · grid
//
// with q any whole number near M grid. Integers wrap, so the difference in brackets is exact modulo
// 2^32, and it is small. Nothing here rests on rounding that a compiler may change.
//
// Holds while |p_i| < 2^19 in the last octave: ten octaves of lacunarity 2 for |p| < 700. The place
// in the cell is right to 2e-7 there.
#include "noise/noise.glsl"

// By kind: see FractalKind. Make it of constants wherever possible: compilers then drop all that
// belongs to the other kinds and basis.
const int fractal_fbm = 0;
const int fractal_hybrid = 1;
const int fractal_ridged = 2;
const int fractal_turbulence = 3;
const int fractal_eroded = 4;

struct Fractal {
  int kind;
  int basis;
  int octaves;
  float lacunarity;
  float hurst;
  float offset;
  float gain;
  float smooth_ridges;
  float damping;
};

Fractal default_fractal() {
  return Fractal(fractal_fbm, noise_basis_gradient, 10, 2.0, 1.0, 1.0, 2.0, 0.0, 1.0);
}

float octave_weight(float spacing) {
  float t = clamp(0.5 / max(spacing, 0.25) - 1.0, 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

float amplitude_ratio(Fractal f) {
  return f.hurst == 1.0 ? 1.0 / f.lacunarity : pow(f.lacunarity, -f.hurst);
}

uint octave_key(uint seed, int octave) {
  return lattice_key(seed + uint(octave) * 0x9e3779b9u);
}

// A place in units of 1/4096 of a lattice cell, and what is left, in [0, 1].
const float grid_units = 4096.0;

struct LatticePlace2 {
  ivec2 grid;
  vec2 rest;
};
struct LatticePlace3 {
  ivec3 grid;
  vec3 rest;
};

LatticePlace2 lattice_place(vec2 p) {
  vec2 x = p * grid_units;
  vec2 below = floor(x);
  return LatticePlace2(ivec2(below), x - below);
}
LatticePlace3 lattice_place(vec3 p) {
  vec3 x = p * grid_units;
  vec3 below = floor(x);
  return LatticePlace3(ivec3(below), x - below);
}

// The same of a place in metres with so many metres to a cell: as exact as `place`, where
// place / feature_size is not (from the nearest cell's corner no difference is rounded).
LatticePlace2 lattice_place(vec2 place, float feature_size) {
  vec2 cell = floor(place / feature_size + 0.5);
  vec2 within = (place - cell * feature_size) * grid_units;
  vec2 units = floor(within / feature_size);
  return LatticePlace2(ivec2(cell) * 4096 + ivec2(units),
                       (within - units * feature_size) / feature_size);
}
LatticePlace3 lattice_place(vec3 place, float feature_size) {
  vec3 cell = floor(place / feature_size + 0.5);
  vec3 within = (place - cell * feature_size) * grid_units;
  vec3 units = floor(within / feature_size);
  return LatticePlace3(ivec3(cell) * 4096 + ivec3(units),
                       (within - units * feature_size) / feature_size);
}

uvec2 lattice_cell(LatticePlace2 p) {
  return uvec2(p.grid >> 12);
}
uvec3 lattice_cell(LatticePlace3 p) {
  return uvec3(p.grid >> 12);
}
vec2 cell_fraction(LatticePlace2 p) {
  return (vec2(p.grid & 4095) + p.rest) / grid_units;
}
vec3 cell_fraction(LatticePlace3 p) {
  return (vec3(p.grid & 4095) + p.rest) / grid_units;
}

// lacunarity · n / denominator as high / 2^20 + low.
void split_products(float lacunarity, ivec3 n, int denominator, out ivec3 high, out vec3 low) {
  int whole = int(lacunarity * 1048576.0);
  float below = lacunarity - float(whole) / 1048576.0;
  high = whole * n / denominator;
  ivec3 left = whole * n - high * denominator;
  low = (vec3(left) / 1048576.0 + below * vec3(n)) / float(denominator);
}

// lacunarity · R in the plane: its cosine and sine, 4/5 and 3/5 of lacunarity.
struct OctaveTurn2 {
  vec2 turn;
  ivec2 high;
  vec2 low;
};

OctaveTurn2 octave_turn2(float lacunarity) {
  ivec3 high;
  vec3 low;
  split_products(lacunarity, ivec3(4, 3, 0), 5, high, low);
  return OctaveTurn2(lacunarity * vec2(0.8, 0.6), high.xy, low.xy);
}

vec2 turned(vec2 turn, vec2 v) {
  return turn.x * v + turn.y * vec2(-v.y, v.x);
}

// By octave_shift: whole units and the rest.
const ivec3 octave_shift_grid = ivec3(2531, 3091, 1696);
const vec3 octave_shift_rest = vec3(0.467217715, 0.978920755, 0.61875159);

LatticePlace2 next_place(LatticePlace2 p, OctaveTurn2 t) {
  vec2 grid = vec2(p.grid);
  ivec2 near = ivec2(turned(t.turn, grid));
  ivec2 left = t.high.x * p.grid + t.high.y * ivec2(-p.grid.y, p.grid.x) - near * 1048576;
  vec2 rest = vec2(left) / 1048576.0 + turned(t.low, grid) + turned(t.turn, p.rest);
  rest += octave_shift_rest.xy;
  vec2 below = floor(rest);
  return LatticePlace2(near + ivec2(below) + octave_shift_grid.xy, rest - below);
}

// In space, by columns; R is of fifteenths.
struct OctaveTurn3 {
  mat3 turn;
  ivec3 high_x;
  ivec3 high_y;
  ivec3 high_z;
  mat3 low;
};

const mat3 octave_matrix = mat3(2.0, 14.0, -5.0, -10.0, 5.0, 10.0, 11.0, 2.0, 10.0) / 15.0;

OctaveTurn3 octave_turn3(float lacunarity) {
  OctaveTurn3 t;
  vec3 x;
  vec3 y;
  vec3 z;
  split_products(lacunarity, ivec3(2, 14, -5), 15, t.high_x, x);
  split_products(lacunarity, ivec3(-10, 5, 10), 15, t.high_y, y);
  split_products(lacunarity, ivec3(11, 2, 10), 15, t.high_z, z);
  t.low = mat3(x, y, z);
  t.turn = octave_matrix * lacunarity;
  return t;
}

LatticePlace3 next_place(LatticePlace3 p, OctaveTurn3 t) {
  vec3 grid = vec3(p.grid);
  ivec3 near = ivec3(t.turn * grid);
  ivec3 left = t.high_x * p.grid.x + t.high_y * p.grid.y + t.high_z * p.grid.z - near * 1048576;
  vec3 rest = vec3(left) / 1048576.0 + t.low * grid + t.turn * p.rest + octave_shift_rest;
  vec3 below = floor(rest);
  return LatticePlace3(near + ivec3(below) + octave_shift_grid, rest - below);
}

// One octave after the other. `turn` (in space `matrix`) is that of p_i against p, for derivatives.
struct Octaves2 {
  LatticePlace2 place;
  OctaveTurn2 step;
  vec2 turn;
  float amplitude;
  float amplitude_ratio;
  float frequency;
  float lacunarity;
  uint seed;
  int index;
};
struct Octaves3 {
  LatticePlace3 place;
  OctaveTurn3 step;
  mat3 matrix;
  float amplitude;
  float amplitude_ratio;
  float frequency;
  float lacunarity;
  uint seed;
  int index;
};

Octaves2 first_octave(LatticePlace2 p, Fractal f, uint seed) {
  return Octaves2(next_place(p, octave_turn2(1.0)), octave_turn2(f.lacunarity), vec2(0.8, 0.6), 1.0,
                  amplitude_ratio(f), 1.0, f.lacunarity, seed, 0);
}
Octaves3 first_octave(LatticePlace3 p, Fractal f, uint seed) {
  return Octaves3(next_place(p, octave_turn3(1.0)), octave_turn3(f.lacunarity), octave_matrix, 1.0,
                  amplitude_ratio(f), 1.0, f.lacunarity, seed, 0);
}

void to_next(inout Octaves2 o) {
  o.place = next_place(o.place, o.step);
  o.turn = turned(o.step.turn, o.turn);
  o.amplitude *= o.amplitude_ratio;
  o.frequency *= o.lacunarity;
  ++o.index;
}
void to_next(inout Octaves3 o) {
  o.place = next_place(o.place, o.step);
  o.matrix = o.step.turn * o.matrix;
  o.amplitude *= o.amplitude_ratio;
  o.frequency *= o.lacunarity;
  ++o.index;
}

// With the derivative by p.
vec3 octave_noise(Octaves2 o, int basis) {
  uvec2 cell = lattice_cell(o.place);
  vec2 t = cell_fraction(o.place);
  uint key = octave_key(o.seed, o.index);
  vec3 n = basis == noise_basis_gradient ? gradient_noise_in(cell, t, key)
                                         : value_noise_in(cell, t, key);
  return vec3(n.x, turned(vec2(o.turn.x, -o.turn.y), n.yz));
}
vec4 octave_noise(Octaves3 o, int basis) {
  uvec3 cell = lattice_cell(o.place);
  vec3 t = cell_fraction(o.place);
  uint key = octave_key(o.seed, o.index);
  vec4 n = basis == noise_basis_gradient ? gradient_noise_in(cell, t, key)
                                         : value_noise_in(cell, t, key);
  return vec4(n.x, n.yzw * o.matrix);
}
