// Twin of noise/noise.hpp and noise/noise_cell.hpp: value and gradient noise, as (value, derivative
// by x, y and z), and as value alone, which is quicker. `…_in` takes a position as lattice cell,
// place in the cell and lattice key.
#include "noise/lattice.glsl"

const int noise_basis_gradient = 0;
const int noise_basis_value = 1;

float fade(float t) {
  return t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
}
vec2 fade(vec2 t) {
  return t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
}
vec3 fade(vec3 t) {
  return t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
}
vec2 fade_slope(vec2 t) {
  vec2 a = t * (1.0 - t);
  return 30.0 * a * a;
}
vec3 fade_slope(vec3 t) {
  vec3 a = t * (1.0 - t);
  return 30.0 * a * a;
}

// Between the corners (0, 0), (1, 0), (0, 1), (1, 1).
float between_corners(vec4 corners, vec2 u) {
  vec2 along = mix(corners.xz, corners.yw, u.x);
  return mix(along.x, along.y, u.y);
}
// The same with the derivatives by u.
vec3 between_corners_slope(vec4 corners, vec2 u) {
  vec2 across = corners.yw - corners.xz;
  vec2 along = corners.xz + u.x * across;
  float rise = along.y - along.x;
  return vec3(along.x + u.y * rise, mix(across.x, across.y, u.y), rise);
}

float value_noise_value_in(uvec2 cell, vec2 t, uint key) {
  return between_corners(lattice_values(lattice_corners(cell.x, cell.y, key)), fade(t));
}

vec3 value_noise_in(uvec2 cell, vec2 t, uint key) {
  vec3 n = between_corners_slope(lattice_values(lattice_corners(cell.x, cell.y, key)), fade(t));
  return vec3(n.x, n.yz * fade_slope(t));
}

float gradient_noise_value_in(uvec2 cell, vec2 t, uint key) {
  vec4 x;
  vec4 y;
  lattice_gradients2(lattice_corners(cell.x, cell.y, key), x, y);
  vec2 back = t - 1.0;
  vec4 d = x * vec4(t.x, back.x, t.x, back.x) + y * vec4(t.yy, back.yy);
  return between_corners(d, fade(t));
}

vec3 gradient_noise_in(uvec2 cell, vec2 t, uint key) {
  vec4 x;
  vec4 y;
  lattice_gradients2(lattice_corners(cell.x, cell.y, key), x, y);
  vec2 back = t - 1.0;
  vec4 d = x * vec4(t.x, back.x, t.x, back.x) + y * vec4(t.yy, back.yy);
  vec2 u = fade(t);
  vec3 n = between_corners_slope(d, u);
  vec2 gradient = vec2(between_corners(x, u), between_corners(y, u));
  return vec3(n.x, gradient + n.yz * fade_slope(t));
}

float value_noise_value_in(uvec3 cell, vec3 t, uint key) {
  vec4 front = lattice_values(lattice_corners(cell.x, cell.y, lattice_line(cell.z, key)));
  vec4 back = lattice_values(lattice_corners(cell.x, cell.y, lattice_line(cell.z + 1u, key)));
  vec3 u = fade(t);
  return between_corners(mix(front, back, u.z), u.xy);
}

vec4 value_noise_in(uvec3 cell, vec3 t, uint key) {
  vec4 front = lattice_values(lattice_corners(cell.x, cell.y, lattice_line(cell.z, key)));
  vec4 back = lattice_values(lattice_corners(cell.x, cell.y, lattice_line(cell.z + 1u, key)));
  vec3 u = fade(t);
  vec3 n = between_corners_slope(mix(front, back, u.z), u.xy);
  return vec4(n.x, vec3(n.yz, between_corners(back - front, u.xy)) * fade_slope(t));
}

float gradient_noise_value_in(uvec3 cell, vec3 t, uint key) {
  vec4 x;
  vec4 y;
  vec4 z;
  vec4 along = vec4(t.x, t.x - 1.0, t.x, t.x - 1.0);
  vec4 up = vec4(t.yy, t.yy - 1.0);
  lattice_gradients3(lattice_corners(cell.x, cell.y, lattice_line(cell.z, key)), x, y, z);
  vec4 front = x * along + y * up + z * t.z;
  lattice_gradients3(lattice_corners(cell.x, cell.y, lattice_line(cell.z + 1u, key)), x, y, z);
  vec4 back = x * along + y * up + z * (t.z - 1.0);
  vec3 u = fade(t);
  return between_corners(mix(front, back, u.z), u.xy);
}

vec4 gradient_noise_in(uvec3 cell, vec3 t, uint key) {
  vec4 x0;
  vec4 y0;
  vec4 z0;
  vec4 x1;
  vec4 y1;
  vec4 z1;
  lattice_gradients3(lattice_corners(cell.x, cell.y, lattice_line(cell.z, key)), x0, y0, z0);
  lattice_gradients3(lattice_corners(cell.x, cell.y, lattice_line(cell.z + 1u, key)), x1, y1, z1);
  vec4 along = vec4(t.x, t.x - 1.0, t.x, t.x - 1.0);
  vec4 up = vec4(t.yy, t.yy - 1.0);
  vec4 front = x0 * along + y0 * up + z0 * t.z;
  vec4 back = x1 * along + y1 * up + z1 * (t.z - 1.0);
  vec3 u = fade(t);
  vec3 n = between_corners_slope(mix(front, back, u.z), u.xy);
  vec3 gradient = vec3(between_corners(mix(x0, x1, u.z), u.xy),
                       between_corners(mix(y0, y1, u.z), u.xy),
                       between_corners(mix(z0, z1, u.z), u.xy));
  vec3 rise = vec3(n.yz, between_corners(back - front, u.xy));
  return vec4(n.x, gradient + rise * fade_slope(t));
}

// At a position in lattice units, with a seed. |p| < 2^31.
vec3 value_noise(vec2 p, uint seed) {
  vec2 below = floor(p);
  return value_noise_in(uvec2(ivec2(below)), p - below, lattice_key(seed));
}
vec3 gradient_noise(vec2 p, uint seed) {
  vec2 below = floor(p);
  return gradient_noise_in(uvec2(ivec2(below)), p - below, lattice_key(seed));
}
vec4 value_noise(vec3 p, uint seed) {
  vec3 below = floor(p);
  return value_noise_in(uvec3(ivec3(below)), p - below, lattice_key(seed));
}
vec4 gradient_noise(vec3 p, uint seed) {
  vec3 below = floor(p);
  return gradient_noise_in(uvec3(ivec3(below)), p - below, lattice_key(seed));
}
float value_noise_value(vec2 p, uint seed) {
  vec2 below = floor(p);
  return value_noise_value_in(uvec2(ivec2(below)), p - below, lattice_key(seed));
}
float gradient_noise_value(vec2 p, uint seed) {
  vec2 below = floor(p);
  return gradient_noise_value_in(uvec2(ivec2(below)), p - below, lattice_key(seed));
}
float value_noise_value(vec3 p, uint seed) {
  vec3 below = floor(p);
  return value_noise_value_in(uvec3(ivec3(below)), p - below, lattice_key(seed));
}
float gradient_noise_value(vec3 p, uint seed) {
  vec3 below = floor(p);
  return gradient_noise_value_in(uvec3(ivec3(below)), p - below, lattice_key(seed));
}
