// The land around the eye, baked: level k has a texel every ring_cell · 2^k metres, in a square
// about the eye. A texel stays where it is when the square moves on: places wrap.

uniform highp sampler2DArray ring_heights;  // height (m), its derivative east and north
uniform highp sampler2DArray ring_maxima;   // of the patches between four texels, with mipmaps
uniform highp sampler2DArray ring_horizons; // what sun_shadow finds: least, and its 1 / distance
uniform int ring_size;        // texels on a side, a power of two
uniform int ring_levels;
uniform float ring_cell;      // m
uniform vec2 ring_eye;        // the place that the squares lie about
uniform int horizon_size;
uniform int horizon_levels;
uniform int horizon_first;    // level of the heights whose cells the first of the horizons has

// Part of the half square that is sure to be there.
const float ring_margin = 12.0;  // texels

float ring_reach(int level) {
  return (0.5 * float(ring_size) - ring_margin) * ring_cell * exp2(float(level));
}

// The finest level that reaches a place so far away (in the larger of its coordinates).
int level_reaching(float away) {
  float level = ceil(log2(max(away / ring_reach(0), 1e-6)));
  return int(clamp(level, 0.0, float(ring_levels - 1)));
}
float away_from_eye(vec2 place) {
  vec2 offset = abs(place - ring_eye);
  return max(offset.x, offset.y);
}

// Cubic Hermite patch, its twists 0. Height and derivative.
vec3 ring_patch(vec2 place, int level) {
  float cell = ring_cell * exp2(float(level));
  vec2 at = place / cell;
  vec2 below = floor(at);
  vec2 t = at - below;
  ivec2 low = ivec2(below) & (ring_size - 1);
  ivec2 high = (low + 1) & (ring_size - 1);
  vec3 a = texelFetch(ring_heights, ivec3(low, level), 0).xyz;
  vec3 b = texelFetch(ring_heights, ivec3(high.x, low.y, level), 0).xyz;
  vec3 c = texelFetch(ring_heights, ivec3(low.x, high.y, level), 0).xyz;
  vec3 d = texelFetch(ring_heights, ivec3(high, level), 0).xyz;
  vec2 s = 1.0 - t;
  vec2 h1 = t * t * (3.0 - 2.0 * t);
  vec2 h0 = 1.0 - h1;
  vec2 g0 = t * s * s * cell;
  vec2 g1 = -t * t * s * cell;
  vec2 dh = 6.0 * t * s / cell;
  vec2 dg0 = s * (1.0 - 3.0 * t);
  vec2 dg1 = t * (3.0 * t - 2.0);
  float low_x = h0.x * a.x + h1.x * b.x + g0.x * a.y + g1.x * b.y;
  float high_x = h0.x * c.x + h1.x * d.x + g0.x * c.y + g1.x * d.y;
  float low_y = h0.x * a.z + h1.x * b.z;
  float high_y = h0.x * c.z + h1.x * d.z;
  float low_dx = dh.x * (b.x - a.x) + dg0.x * a.y + dg1.x * b.y;
  float high_dx = dh.x * (d.x - c.x) + dg0.x * c.y + dg1.x * d.y;
  float low_ydx = dh.x * (b.z - a.z);
  float high_ydx = dh.x * (d.z - c.z);
  return vec3(h0.y * low_x + h1.y * high_x + g0.y * low_y + g1.y * high_y,
              h0.y * low_dx + h1.y * high_dx + g0.y * low_ydx + g1.y * high_ydx,
              dh.y * (high_x - low_x) + dg0.y * low_y + dg1.y * high_y);
}

// Between levels: the land as samples `spacing` apart show it.
vec3 ring_ground(vec2 place, float spacing) {
  float level = log2(max(spacing / ring_cell, 1.0));
  level = clamp(level, float(level_reaching(away_from_eye(place))), float(ring_levels - 1));
  int fine = int(level);
  vec3 ground = ring_patch(place, fine);
  float share = level - float(fine);
  return share > 0.02 ? mix(ground, ring_patch(place, min(fine + 1, ring_levels - 1)), share)
                      : ground;
}

// Height alone, bilinear, of the nearest level that is coarse enough.
float ring_height(vec2 place, float spacing) {
  int level = max(int(log2(max(spacing / ring_cell, 1.0)) + 0.5),
                  level_reaching(away_from_eye(place)));
  level = min(level, ring_levels - 1);
  vec2 at = place / (ring_cell * exp2(float(level)));
  return textureLod(ring_heights, vec3((at + 0.5) / float(ring_size), float(level)), 0.0).x;
}

// The baked land lacks what is finer than its cells: it counts as met a part of a cell above it.
const float ring_lift = 0.3;

float baked_height(vec2 place, float cell, int level) {
  return textureLod(ring_heights,
                    vec3((place / cell + 0.5) / float(ring_size), float(level)), 0.0).x;
}

// Distance, from t on, to where the baked land is met, or -1: down and up the pyramid of maxima
// (Tevs, Ihrke, Seidel, "Maximum mipmaps for fast, accurate, and scalable dynamic height field
// rendering", I3D 2008). The land falls away from a ray's tangent, so a ray's height over it is
// convex along the ray.
float march_rings(LandRay ray, float t, float end) {
  vec2 way = ray.direction.xy;
  vec2 steep = vec2(abs(way.x) < 1e-6 ? 1e6 : 1.0 / way.x, abs(way.y) < 1e-6 ? 1e6 : 1.0 / way.y);
  vec2 ahead = step(vec2(0.0), way);
  float flat_way = max(max(abs(way.x), abs(way.y)), 1e-6);
  vec2 eye_offset = abs(ray.place - ring_eye);
  float offset = max(eye_offset.x, eye_offset.y);
  int level = level_reaching(t * flat_way + offset);
  float cell = ring_cell * exp2(float(level));
  float level_end = level < ring_levels - 1 ? (ring_reach(level) - offset) / flat_way : 1e30;
  float height = height_along(ray, t);
  int top = int(log2(float(ring_size))) - 3;
  int up = 2;
  for (int i = ZERO; i < 600 && t < end; ++i) {
    float size = cell * float(1 << up);
    vec2 place = place_along(ray, t);
    vec2 corner = floor(place / size);
    vec2 leaving = ((corner + ahead) * size - place) * steep;
    float slack = 1e-3 * cell / flat_way + 2e-7 * t;
    float to = t + max(min(leaving.x, leaving.y), 0.0) + slack;
    to = min(min(to, level_end + slack), end);
    float height_then = height_along(ray, to);
    float lift = EPSILON * t + ring_lift * cell;
    float sag = (to - t) * (to - t) / (8.0 * AIR.planet_radius);
    ivec2 texel = ivec2(corner);
    bool above = min(height, height_then) - sag - lift >
                 texelFetch(ring_maxima, ivec3(texel & ((ring_size >> up) - 1), level), up).r;
    if (!above && up > 0) {
      up -= 1;
      continue;
    }
    vec2 place_then = place_along(ray, to);
    if (!above) {
      float over = height_then - lift - baked_height(place_then, cell, level);
      if (over < 0.0) {
        float before = max(height - lift - baked_height(place, cell, level), 0.0);
        return mix(t, to, before / (before - over));
      }
    }
    t = to;
    height = height_then;
    if (t > level_end) {
      level += 1;
      cell *= 2.0;
      level_end = level < ring_levels - 1 ? (ring_reach(level) - offset) / flat_way : 1e30;
      up = max(up - 1, 0);
    } else if ((ivec2(floor(place_then / size)) >> 1) != (texel >> 1)) {
      up = min(up + 1, top);
    }
  }
  return -1.0;
}
