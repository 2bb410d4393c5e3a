// Twin of the heights of render/ground.hpp: the ground's height at every place, with its gradient,
// in any detail, and the level of water over it.
//
// Places are in metres from an anchor near the eye, so that `float` keeps fine detail far from the
// world's origin: textures and noises know where the anchor lies, as whole cells and a fraction
// (raster/ground_textures.hpp). A sample is (height, dh/dx, dh/dy).
#include "noise/noise.glsl"

// A grid of samples: the anchor lies at sample `cell` + `fraction`.
struct GroundGrid {
  ivec2 size;
  ivec2 cell;
  vec2 fraction;
  float per_metre;
};

const int most_covers = 8;
const float no_water = -1e9;

uniform GroundGrid field_grid;
uniform GroundGrid around_grid;
uniform vec2 field_low;   // m from the anchor
uniform vec2 field_high;
uniform bool has_around;
uniform sampler2D field_heights;   // with a sample more on each side
uniform sampler2D around_heights;
uniform bool has_inner_water;
uniform bool has_outer_water;
uniform sampler2D inner_water;  // levels, m
uniform sampler2D outer_water;

uniform usampler2D ground_octaves;  // a row per octave: key, cell; fraction, amplitude

uniform int cover_count;
uniform GroundGrid inner_cover_grid;
uniform GroundGrid outer_cover_grid;
uniform sampler2DArray inner_covers;
uniform sampler2DArray outer_covers;
uniform vec4 cover_ranges[most_covers];  // low, high, feather, edge noise
uniform vec4 cover_kinds[most_covers];   // detail, over snow, has an inner map, has an outer map
uniform vec4 cover_looks[most_covers];   // feature size, contrast, roughness, opacity

uniform vec4 ground_shares;  // grass cover, patch size, distant forest, detail
uniform vec4 ground_slopes;  // of rock, of snow: low, high, degrees
uniform float widest_detail;

// Rows of `ground_octaves`, and how many.
const int detail_row = 0;
const int edges_row = 9;
const int grains_row = 14;
const int patches_row = 18;
const int woods_row = 23;
const int crowns_row = 29;
const int ripples_row = 32;
const int textures_row = 36;  // five octaves each: soil, grass, rock, canopy, covers

const float detail_ratio_soil = 0.035;
const float detail_ratio_rock = 0.11;
const float wood_size = 420.0;
const float crown_size = 9.0;
const float crown_height = 6.0;
const float wood_height = 11.0;
const float steepest_wood = 42.0;

// smoothstep, and a plain step where the edges are equal.
float ground_step(float low, float high, float x) {
  if (high <= low) return x < low ? 0.0 : 1.0;
  float t = clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

float slope_degrees(vec2 gradient) {
  return degrees(atan(length(gradient)));
}

// Noises. Octave i looks at M q + (cell + fraction), M = 2^i R^(i + 1), R octave_turn2 and
// octave_turn3 of noise/fractal.hpp.
const mat2 ground_turn2 = mat2(0.8, 0.6, -0.6, 0.8);
const mat3 ground_turn3 = mat3(4.0, 28.0, -10.0, -20.0, 10.0, 20.0, 22.0, 4.0, 20.0) / 30.0;

float ground_octave_weight(float spacing) {
  float t = clamp(0.5 / max(spacing, 0.25) - 1.0, 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

// fBm, or with `billows` turbulence, at q lattice units from the anchor, with derivatives.
vec3 ground_fractal(int row, int octaves, bool billows, vec2 q, float spacing) {
  vec3 sum = vec3(0.0);
  mat2 m = ground_turn2;
  for (int i = 0; i < octaves; ++i) {
    float weight = ground_octave_weight(spacing);
    if (weight <= 0.0) break;
    uvec4 key = texelFetch(ground_octaves, ivec2(0, row + i), 0);
    vec4 rest = uintBitsToFloat(texelFetch(ground_octaves, ivec2(1, row + i), 0));
    vec2 p = m * q + rest.xy;
    vec2 below = floor(p);
    vec3 n = gradient_noise_in(key.yz + uvec2(ivec2(below)), p - below, key.x);
    if (billows && n.x < 0.0) n = -n;
    sum += (weight * rest.w) * vec3(n.x, n.yz * m);
    m = 2.0 * ground_turn2 * m;
    spacing *= 2.0;
  }
  return sum;
}

// fBm without derivatives.
float ground_fbm(int row, int octaves, vec2 q, float spacing) {
  float sum = 0.0;
  for (int i = 0; i < octaves; ++i) {
    float weight = ground_octave_weight(spacing);
    if (weight <= 0.0) break;
    q = ground_turn2 * q;
    uvec4 key = texelFetch(ground_octaves, ivec2(0, row + i), 0);
    vec4 rest = uintBitsToFloat(texelFetch(ground_octaves, ivec2(1, row + i), 0));
    vec2 p = q + rest.xy;
    vec2 below = floor(p);
    sum += weight * rest.w *
           gradient_noise_value_in(key.yz + uvec2(ivec2(below)), p - below, key.x);
    q *= 2.0;
    spacing *= 2.0;
  }
  return sum;
}
float ground_fbm(int row, int octaves, vec3 q, float spacing) {
  float sum = 0.0;
  for (int i = 0; i < octaves; ++i) {
    float weight = ground_octave_weight(spacing);
    if (weight <= 0.0) break;
    q = ground_turn3 * q;
    uvec4 key = texelFetch(ground_octaves, ivec2(0, row + i), 0);
    vec4 rest = uintBitsToFloat(texelFetch(ground_octaves, ivec2(1, row + i), 0));
    vec3 p = q + rest.xyz;
    vec3 below = floor(p);
    sum += weight * rest.w *
           gradient_noise_value_in(key.yzw + uvec3(ivec3(below)), p - below, key.x);
    q *= 2.0;
    spacing *= 2.0;
  }
  return sum;
}

// Grids.
bool grid_contains(GroundGrid g, vec2 place) {
  vec2 x = place * g.per_metre + g.fraction + vec2(g.cell);
  return all(greaterThanEqual(x, vec2(0.0))) && all(lessThanEqual(x, vec2(g.size - 1)));
}

// The sample before a place, and how far it is to the next.
ivec2 grid_place(GroundGrid g, vec2 place, out vec2 t) {
  vec2 x = place * g.per_metre + g.fraction;
  vec2 below = floor(x);
  ivec2 first = ivec2(below) + g.cell;
  ivec2 inside = clamp(first, ivec2(0), max(g.size - 2, ivec2(0)));
  t = x - below;
  if (first.x != inside.x) t.x = first.x < inside.x ? 0.0 : 1.0;
  if (first.y != inside.y) t.y = first.y < inside.y ? 0.0 : 1.0;
  return inside;
}

vec4 cubic_values(float t) {
  float u = 1.0 - t;
  return vec4(-0.5 * t * u * u, 1.0 + t * t * (1.5 * t - 2.5), 1.0 + u * u * (1.5 * u - 2.5),
              -0.5 * u * t * t);
}
vec4 cubic_slopes(float t) {
  float u = 1.0 - t;
  return vec4(-0.5 * u * (1.0 - 3.0 * t), t * (4.5 * t - 5.0), -u * (4.5 * u - 5.0),
              0.5 * t * (3.0 * t - 2.0));
}

vec4 heights_row(sampler2D heights, ivec2 first) {
  return vec4(texelFetch(heights, first, 0).x, texelFetch(heights, first + ivec2(1, 0), 0).x,
              texelFetch(heights, first + ivec2(2, 0), 0).x,
              texelFetch(heights, first + ivec2(3, 0), 0).x);
}

// ground_at (terrain/heightfield.hpp).
vec3 bicubic(sampler2D heights, GroundGrid g, vec2 place) {
  vec2 t;
  ivec2 first = grid_place(g, place, t);
  vec4 r0 = heights_row(heights, first);
  vec4 r1 = heights_row(heights, first + ivec2(0, 1));
  vec4 r2 = heights_row(heights, first + ivec2(0, 2));
  vec4 r3 = heights_row(heights, first + ivec2(0, 3));
  vec4 y = cubic_values(t.y);
  vec4 dy = cubic_slopes(t.y);
  vec4 x = cubic_values(t.x);
  vec4 values = y.x * r0 + y.y * r1 + y.z * r2 + y.w * r3;
  vec4 slopes = dy.x * r0 + dy.y * r1 + dy.z * r2 + dy.w * r3;
  return vec3(dot(x, values), g.per_metre * dot(cubic_slopes(t.x), values),
              g.per_metre * dot(x, slopes));
}

float between_samples(vec4 corners, vec2 t) {
  vec2 along = mix(corners.xz, corners.yw, t.x);
  return mix(along.x, along.y, t.y);
}
float bilinear(sampler2D map, GroundGrid g, vec2 place) {
  vec2 t;
  ivec2 p = grid_place(g, place, t);
  vec4 corners = vec4(texelFetch(map, p, 0).x, texelFetch(map, p + ivec2(1, 0), 0).x,
                      texelFetch(map, p + ivec2(0, 1), 0).x, texelFetch(map, p + ivec2(1, 1), 0).x);
  return between_samples(corners, t);
}
float bilinear(sampler2DArray map, int layer, GroundGrid g, vec2 place) {
  vec2 t;
  ivec2 p = grid_place(g, place, t);
  vec4 corners = vec4(texelFetch(map, ivec3(p, layer), 0).x,
                      texelFetch(map, ivec3(p + ivec2(1, 0), layer), 0).x,
                      texelFetch(map, ivec3(p + ivec2(0, 1), layer), 0).x,
                      texelFetch(map, ivec3(p + ivec2(1, 1), layer), 0).x);
  return between_samples(corners, t);
}

// Heights.
bool inside_field(vec2 place) {
  return !has_around || grid_contains(field_grid, place);
}

// What the surroundings are raised by at a place outside the field.
float ground_lift(vec2 place) {
  if (inside_field(place)) return 0.0;
  vec2 border = clamp(place, field_low, field_high);
  vec2 size = field_high - field_low;
  float share = 1.0 - ground_step(0.0, 0.5 * max(size.x, size.y), distance(border, place));
  if (share <= 0.0) return 0.0;
  return share * (bicubic(field_heights, field_grid, border).x -
                  bicubic(around_heights, around_grid, border).x);
}

// `lift` is that of the place; as it costs much it is handed on.
vec3 ground_base(vec2 place, float lift) {
  if (inside_field(place)) return bicubic(field_heights, field_grid, place);
  return bicubic(around_heights, around_grid, place) + vec3(lift, 0.0, 0.0);
}

float canopy_share(vec2 place, float slope) {
  float forest = ground_shares.z;
  if (forest <= 0.0 || inside_field(place)) return 0.0;
  float gentle = 1.0 - ground_step(steepest_wood - 8.0, steepest_wood, slope);
  if (gentle <= 0.0) return 0.0;
  float wood = ground_fbm(woods_row, 6, place / wood_size, 0.0);
  return gentle * ground_step(0.5 - forest - 0.05, 0.5 - forest + 0.05, wood);
}

float cover_share(int k, vec2 place, float edge_noise) {
  vec4 range = cover_ranges[k];
  float value = edge_noise * range.w;
  if (cover_kinds[k].z > 0.0 && grid_contains(inner_cover_grid, place))
    value += bilinear(inner_covers, k, inner_cover_grid, place);
  else if (cover_kinds[k].w > 0.0 && grid_contains(outer_cover_grid, place))
    value += bilinear(outer_covers, k, outer_cover_grid, place);
  else
    return 0.0;
  float share = cover_looks[k].w * ground_step(range.x - range.z, range.x, value);
  return value > range.y ? share * (1.0 - ground_step(range.y, range.y + range.z, value)) : share;
}

float detail_share(vec2 place) {
  float share = 1.0;
  for (int k = 0; k < cover_count; ++k)
    if (cover_kinds[k].x < 1.0) share *= 1.0 - cover_share(k, place, 0.0) * (1.0 - cover_kinds[k].x);
  return share;
}

// Adds the features of tree crowns, or of soil and stone, down to `spacing` metres.
vec3 with_detail(vec3 s, vec2 place, float canopy, float spacing) {
  if (canopy > 0.0) {
    vec3 n = ground_fractal(crowns_row, 3, true, place / crown_size, spacing / crown_size);
    return s + canopy * vec3(wood_height - crown_height * n.x, -crown_height / crown_size * n.yz);
  }
  float detail = ground_shares.w;
  if (detail <= 0.0 || 2.0 * spacing >= widest_detail) return s;
  float rock = ground_step(ground_slopes.x, ground_slopes.y, slope_degrees(s.yz));
  vec3 n = ground_fractal(detail_row, 9, false, place / widest_detail, spacing / widest_detail);
  float ratio = detail * detail_share(place) * mix(detail_ratio_soil, detail_ratio_rock, rock);
  return s + ratio * vec3(widest_detail * n.x, n.yz);
}

// Level of the water at a place, m; no_water where there is none.
float water_level(vec2 place, float lift) {
  if (inside_field(place))
    return has_inner_water && grid_contains(field_grid, place)
               ? bilinear(inner_water, field_grid, place)
               : no_water;
  return has_outer_water && grid_contains(around_grid, place)
             ? bilinear(outer_water, around_grid, place) + lift
             : no_water;
}

// Ground::detailed.
vec3 ground_detailed(vec2 place, float lift, float spacing) {
  vec3 base = ground_base(place, lift);
  vec3 land = with_detail(base, place, canopy_share(place, slope_degrees(base.yz)), spacing);
  float level = water_level(place, lift);
  return level > land.x ? vec3(level, 0.0, 0.0) : land;
}
