// The land from a finished height map, mirrored beyond its border, with a fractal's detail below
// its cells, and water over it: `land` as a function of the place, for scenes whose steps need the
// whole land.
#include "landscape/patches.glsl"

uniform highp sampler2D height_map;  // m, with mipmaps; a texel per sample

// Bilinear, with derivative per texel, of one level. `at` in texels of level 0.
vec3 map_level(vec2 at, int level) {
  ivec2 size = textureSize(height_map, level);
  vec2 p = (at + 0.5) / exp2(float(level)) - 0.5;
  vec2 below = floor(p);
  vec2 f = p - below;
  ivec2 low = clamp(ivec2(below), ivec2(0), size - 1);
  ivec2 high = clamp(ivec2(below) + 1, ivec2(0), size - 1);
  float a = texelFetch(height_map, low, level).r;
  float b = texelFetch(height_map, ivec2(high.x, low.y), level).r;
  float c = texelFetch(height_map, ivec2(low.x, high.y), level).r;
  float d = texelFetch(height_map, high, level).r;
  float scale = exp2(-float(level));
  vec2 slope = vec2(mix(b - a, d - c, f.y), mix(c - a, d - b, f.x)) * scale;
  return vec3(mix(mix(a, b, f.x), mix(c, d, f.x), f.y), slope);
}

// Catmull-Rom weights and their derivatives.
void cubic_weights(float t, out vec4 w, out vec4 d) {
  float t2 = t * t;
  float t3 = t2 * t;
  w = 0.5 * vec4(-t3 + 2.0 * t2 - t, 3.0 * t3 - 5.0 * t2 + 2.0, -3.0 * t3 + 4.0 * t2 + t, t3 - t2);
  d = 0.5 * vec4(-3.0 * t2 + 4.0 * t - 1.0, 9.0 * t2 - 10.0 * t, -9.0 * t2 + 8.0 * t + 1.0,
                 3.0 * t2 - 2.0 * t);
}

// The same, smooth, of level 0.
vec3 map_smooth(vec2 at) {
  ivec2 last = textureSize(height_map, 0) - 1;
  vec2 below = floor(at);
  vec4 wx, wy, dx, dy;
  cubic_weights(at.x - below.x, wx, dx);
  cubic_weights(at.y - below.y, wy, dy);
  vec3 sum = vec3(0.0);
  for (int j = ZERO; j < 4; ++j) {
    vec2 row = vec2(0.0);
    for (int i = ZERO; i < 4; ++i) {
      ivec2 texel = clamp(ivec2(below) + ivec2(i, j) - 1, ivec2(0), last);
      row += texelFetch(height_map, texel, 0).r * vec2(wx[i], dx[i]);
    }
    sum += vec3(wy[j] * row.x, wy[j] * row.y, dy[j] * row.x);
  }
  return sum;
}

// A place on the map, which is mirrored again and again.
struct MapPlace {
  vec2 at;     // texels of level 0
  vec2 sense;  // -1 where it runs backwards
};

MapPlace on_map(vec2 place) {
  vec2 size = vec2(textureSize(height_map, 0) - 1);
  vec2 turns = (place / MAP_CELL + 0.5 * size) / (2.0 * size);
  vec2 back = abs(fract(turns) * 2.0 - 1.0);
  return MapPlace((1.0 - back) * size, mix(vec2(-1.0), vec2(1.0), lessThan(fract(turns), vec2(0.5))));
}

// The coarsest level of the maps.
float coarsest_level() {
  ivec2 size = textureSize(height_map, 0);
  return floor(log2(float(max(size.x, size.y))) + 1e-4);
}

// Height, derivative by texels.
vec3 ground_on_map(vec2 at, float level) {
  float fine = clamp(floor(level), 0.0, coarsest_level() - 1.0);
  vec3 ground = fine == 0.0 ? map_smooth(at) : map_level(at, int(fine));
  float coarser = clamp(level - fine, 0.0, 1.0);
  return coarser > 0.0 ? mix(ground, map_level(at, int(fine) + 1), coarser) : ground;
}

#if HAS_WATER
#include "landscape/water_map.glsl"
#endif

// What is seen, ground or water; `water` is the share of the place that is under it, and its depth.
vec3 land(vec2 place, float spacing, out vec2 water) {
  MapPlace on = on_map(place);
  float level = log2(max(spacing / MAP_CELL, 1e-3));
  vec3 ground = ground_on_map(on.at, level);
  ground.yz *= on.sense / MAP_CELL;
  float bare = ground.x;
  if (spacing < MAP_CELL) {
    float steep = smoothstep(0.25, 0.9, length(ground.yz));
    float size_below = 2.0 * MAP_CELL;
    vec3 n = patches_slope(place, size_below, spacing, 9, 41u);
    ground += mix(0.015, 0.075, steep) * size_below * n;
  }
  water = vec2(0.0);
#if HAS_WATER
  ground = under_water(ground, bare, on, level, water);
#endif
  return ground;
}

vec3 land(vec2 place, float spacing) {
  vec2 water;
  return land(place, spacing, water);
}
