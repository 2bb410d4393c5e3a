// The land as the shader sees it: `land` of the scene, higher or wider by the knobs, on a planet.
#include "sky/atmosphere.glsl"

// Samples so far apart show this many octaves below the largest features of the land, m.
float finest_spacing(int octaves) {
  return TERRAIN_SCALE * LARGEST_FEATURE * exp2(-float(octaves) - 1.0);
}

#if HAS_WATER
// With the share of the place under water, and its depth (m).
vec3 terrain(vec2 place, float spacing, out vec2 water) {
  vec3 ground = land(place / TERRAIN_SCALE, spacing / TERRAIN_SCALE, water);
  water.y *= TERRAIN_HEIGHT;
  return vec3(TERRAIN_HEIGHT * ground.x, TERRAIN_HEIGHT / TERRAIN_SCALE * ground.yz);
}
#endif

// Height (m) over a place, with its derivative.
vec3 terrain(vec2 place, float spacing) {
  vec3 ground = land(place / TERRAIN_SCALE, spacing / TERRAIN_SCALE);
  return vec3(TERRAIN_HEIGHT * ground.x, TERRAIN_HEIGHT / TERRAIN_SCALE * ground.yz);
}

// A ray from `height` metres over the place (0, 0) of the planet; the land is moved below it, so
// that coordinates stay small and the planet round.
struct LandRay {
  vec2 place;  // on the land, m
  float height;
  vec3 direction;
};

float height_along(LandRay ray, float t) {
  return height_after(AIR, ray.height, ray.direction.z, t);
}

vec2 place_along(LandRay ray, float t) {
  return ray.place + t * ray.direction.xy;
}

// Distance to the land, or -1. h is the height over the land: the march goes on by a share of it
// until h < EPSILON t; then the last step is halved until the land is met exactly (in the same
// loop, so that compilers see the land once).
float march_terrain(LandRay ray, float pixel_angle) {
  Crossing below = crossing(AIR, ray.height, ray.direction.z, HIGHEST_LAND * TERRAIN_HEIGHT);
  if (!below.meets || below.far_distance <= 0.0) return -1.0;
  float end = min(MAX_RENDERING_DISTANCE, below.far_distance);
  float finest = finest_spacing(OCTAVES);
  float t = max(below.near_distance, 0.5);
  float before = t;
  float after = t;
  float h = 0.0;
  int halvings = 0;
  for (int i = ZERO; i < MAX_MARCHING_STEPS && t < end && halvings < 7; ++i) {
    h = height_along(ray, t) - terrain(place_along(ray, t), max(finest, 0.7 * pixel_angle * t)).x;
    bool met = h < EPSILON * t;
    if (met) after = t;
    else before = t;
    halvings += int(met || halvings > 0);
    t = halvings > 0 ? 0.5 * (before + after) : t + MARCHING_FACTOR * h + 0.002 * t;
  }
  if (halvings > 0) return after;
  return h < 20.0 * EPSILON * t && t < end ? t : -1.0;
}

// Share of the sun that a place sees: from the smallest h / t along the way to it, which tells how
// much of a disc of the angle SUN_SOFTNESS the land hides.
float sun_shadow(LandRay ray, float spacing) {
  float finest = max(finest_spacing(OCTAVES_SHADOW), spacing);
  Crossing above = crossing(AIR, ray.height, ray.direction.z, HIGHEST_LAND * TERRAIN_HEIGHT);
  if (!above.meets || above.far_distance <= 0.0) return 1.0;
  float end = min(above.far_distance, MAX_RENDERING_DISTANCE);
  float least = 1.0;
  float t = 2.0 * finest;
  for (int i = ZERO; i < MAX_MARCHING_STEPS_SHADOW && t < end; ++i) {
    float h = height_along(ray, t) - terrain(place_along(ray, t), max(finest, 0.004 * t)).x;
    least = min(least, h / (SUN_SOFTNESS * t));
    if (least < -1.0) break;
    t += clamp(0.6 * h, 0.02 * t + finest, 0.1 * end);
  }
  least = clamp(least, -1.0, 1.0);
  return 0.25 * (1.0 + least) * (1.0 + least) * (2.0 - least);
}
