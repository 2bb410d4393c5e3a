// Twin of noise/noise_curvature.hpp: noise with first and second derivatives.
#include "noise/noise.glsl"

struct Curvature2 {
  float value;
  vec2 slope;
  mat2 second;
};
struct Curvature3 {
  float value;
  vec3 slope;
  mat3 second;
};

vec2 fade_curvature(vec2 t) {
  return 60.0 * t * (t * (2.0 * t - 3.0) + 1.0);
}
vec3 fade_curvature(vec3 t) {
  return 60.0 * t * (t * (2.0 * t - 3.0) + 1.0);
}

// With a = corner values and gradients (x, y) at the corners, each blended over the cell:
// n_xx = f''(x) Δ + 2 f'(x) Δg_x, n_xy = f'(x) f'(y) ΔΔ + f'(x) Δ_x g_y + f'(y) Δ_y g_x.
Curvature2 blended_curvature(vec4 d, vec4 x, vec4 y, vec2 t) {
  vec2 u = fade(t);
  vec2 r = fade_slope(t);
  vec3 n = between_corners_slope(d, u);
  vec3 gx = between_corners_slope(x, u);
  vec3 gy = between_corners_slope(y, u);
  vec2 second = fade_curvature(t) * n.yz + 2.0 * r * vec2(gx.y, gy.z);
  float mixed = r.x * r.y * (d.x - d.y - d.z + d.w) + r.x * gy.y + r.y * gx.z;
  return Curvature2(n.x, vec2(gx.x, gy.x) + r * n.yz, mat2(second.x, mixed, mixed, second.y));
}

Curvature2 gradient_curvature_in(uvec2 cell, vec2 t, uint key) {
  vec4 x;
  vec4 y;
  lattice_gradients2(lattice_corners(cell.x, cell.y, key), x, y);
  vec2 back = t - 1.0;
  vec4 d = x * vec4(t.x, back.x, t.x, back.x) + y * vec4(t.yy, back.yy);
  return blended_curvature(d, x, y, t);
}
Curvature2 value_curvature_in(uvec2 cell, vec2 t, uint key) {
  vec4 d = lattice_values(lattice_corners(cell.x, cell.y, key));
  return blended_curvature(d, vec4(0.0), vec4(0.0), t);
}

// (value, derivatives by u.x, u.y, u.z) between the planes `front` and `back`.
vec4 between_planes_slope(vec4 front, vec4 back, vec3 u) {
  vec3 n = between_corners_slope(mix(front, back, u.z), u.xy);
  return vec4(n, between_corners(back - front, u.xy));
}
float twist(vec4 d) {
  return d.x - d.y - d.z + d.w;
}

Curvature3 blended_curvature(vec4 d0, vec4 d1, vec4 x0, vec4 x1, vec4 y0, vec4 y1, vec4 z0,
                             vec4 z1, vec3 t) {
  vec3 u = fade(t);
  vec3 r = fade_slope(t);
  vec4 n = between_planes_slope(d0, d1, u);
  vec4 gx = between_planes_slope(x0, x1, u);
  vec4 gy = between_planes_slope(y0, y1, u);
  vec4 gz = between_planes_slope(z0, z1, u);
  vec3 s = fade_curvature(t) * n.yzw + 2.0 * r * vec3(gx.y, gy.z, gz.w);
  vec2 rise = between_corners_slope(d1 - d0, u.xy).yz;
  float xy = r.x * r.y * twist(mix(d0, d1, u.z)) + r.x * gy.y + r.y * gx.z;
  float xz = r.x * r.z * rise.x + r.x * gz.y + r.z * gx.w;
  float yz = r.y * r.z * rise.y + r.y * gz.z + r.z * gy.w;
  return Curvature3(n.x, vec3(gx.x, gy.x, gz.x) + r * n.yzw,
                    mat3(s.x, xy, xz, xy, s.y, yz, xz, yz, s.z));
}

Curvature3 gradient_curvature_in(uvec3 cell, vec3 t, uint key) {
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
  vec4 d0 = x0 * along + y0 * up + z0 * t.z;
  vec4 d1 = x1 * along + y1 * up + z1 * (t.z - 1.0);
  return blended_curvature(d0, d1, x0, x1, y0, y1, z0, z1, t);
}
Curvature3 value_curvature_in(uvec3 cell, vec3 t, uint key) {
  vec4 d0 = lattice_values(lattice_corners(cell.x, cell.y, lattice_line(cell.z, key)));
  vec4 d1 = lattice_values(lattice_corners(cell.x, cell.y, lattice_line(cell.z + 1u, key)));
  const vec4 none = vec4(0.0);
  return blended_curvature(d0, d1, none, none, none, none, none, none, t);
}
