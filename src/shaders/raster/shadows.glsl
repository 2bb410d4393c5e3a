// What stands between a surface and the sun, or the sky (raster/shadow_maps.hpp, canopy_shade.hpp).
#include "raster/interleaved_noise.glsl"
#include "raster/terrain_shadow.glsl"
#include "raster/view.glsl"

const int cascades = 4;

uniform vec3 sun_direction;   // unit, towards the sun

uniform int shadow_count;                // of cascades; 0: no shadow maps
uniform sampler2D shadow_atlas;          // depth, nearest to the sun 1; two by two cascades
uniform mat4 shadow_matrices[cascades];  // world to x, y in [-1, 1] and depth in [0, 1]
uniform float shadow_texels[cascades];   // m
uniform float shadow_lifts[cascades];    // m, off what shades itself
uniform float shadow_blur;               // radius, in [-1, 1] of a cascade
uniform float shadow_turn;               // radians, another for each frame
uniform vec2 depth_range;                // depth = x + y · depth as stored

// Leaf area per m² of ground, that times its foot and top (m), and its mean around.
uniform sampler2D canopy_map;
uniform vec4 canopy_place;     // texture = zw + xy · place; all 0: no crowns
// Of small plants about the eye: leaf area, and that times the part of the light that they scatter.
uniform sampler2D undergrowth_map;
uniform vec4 undergrowth_place;

// Of a cascade: 1 where the sun is seen.
float shadow_tap(int cascade, vec3 at) {
  vec2 corner = vec2(float(cascade & 1), float(cascade >> 1)) * 0.5;
  float stored = texture(shadow_atlas, corner + 0.25 * (at.xy + 1.0)).r;
  return depth_range.x + depth_range.y * stored > at.z ? 0.0 : 1.0;
}

float cascade_share(int cascade, vec3 at) {
  const int taps = 8;
  float turn = 6.2831853 * interleaved_noise(gl_FragCoord.xy) + shadow_turn;
  float sum = 0.0;
  for (int k = 0; k < taps; ++k) {
    // Vogel's spiral.
    float angle = 2.39996323 * float(k) + turn;
    float r = shadow_blur * sqrt((float(k) + 0.5) / float(taps));
    sum += shadow_tap(cascade, vec3(at.xy + r * vec2(cos(angle), sin(angle)), at.z));
  }
  return sum / float(taps);
}

// Of crowns, as a mean around: leaf area per m² of ground.
float canopy_around(vec3 place) {
  if (canopy_place.x == 0.0) return 0.0;
  return texture(canopy_map, canopy_place.zw + canopy_place.xy * place.xy).w;
}

// Leaf area per m² of ground of crowns overhead and, as a mean, around, above a height.
vec2 canopy_above(vec3 place) {
  if (canopy_place.x == 0.0) return vec2(0.0);
  vec2 at = canopy_place.zw + canopy_place.xy * place.xy;
  if (any(lessThan(at, vec2(0.0))) || any(greaterThan(at, vec2(1.0)))) return vec2(0.0);
  vec4 crowns = texture(canopy_map, at);
  if (crowns.x <= 0.0) return vec2(0.0, crowns.w);
  float foot = crowns.y / crowns.x;
  float top = crowns.z / crowns.x;
  float above = clamp((top - place.z) / max(top - foot, 0.5), 0.0, 1.0);
  return above * crowns.xw;
}

// Part of the sky that crowns above let through.
float under_canopy(vec3 place) {
  vec2 leaves = canopy_above(place);
  return exp(-0.5 * leaves.x) * 0.5 + 0.5 * exp(-0.7 * leaves.y);
}

struct Undergrowth {
  float leaves;  // area per m² of ground
  vec3 paler;    // extinction of its leaves against that of black ones
};

// Of leaves that scatter a part ω of the light: sqrt(1 - ω). J. Goudriaan, "Crop micrometeorology: a
// simulation study", Pudoc 1977.
Undergrowth undergrowth_at(vec3 place) {
  if (undergrowth_place.x == 0.0) return Undergrowth(0.0, vec3(1.0));
  vec2 at = undergrowth_place.zw + undergrowth_place.xy * place.xy;
  vec2 inside = smoothstep(0.0, 0.1, at) * (1.0 - smoothstep(0.9, 1.0, at));
  vec4 leaves = texture(undergrowth_map, at) * inside.x * inside.y;
  return Undergrowth(leaves.x, sqrt(1.0 - clamp(leaves.yzw / max(leaves.x, 1e-3), 0.0, 1.0)));
}

// Part of the sky that small plants let through to the ground under them: of an even sky through
// wide beds of leaves, whose slanting ways are longer, 2 E3(L / 2), nearly exp(-1.6 L / 2) (the
// diffusivity factor of radiation in layers: Elsasser, 1942).
vec3 sky_through(Undergrowth u) {
  return exp(-0.8 * u.leaves * u.paler);
}

// Part of the sun, on the level, that comes down from leaf to leaf.
vec3 sun_scattered_by(Undergrowth u) {
  float black = 0.5 * u.leaves / max(sun_direction.z, 0.1);
  return exp(-black * u.paler) - exp(-black);
}

// Part of the sun that crowns around let through, on the mean: where there are no shadow maps.
float sun_through_canopy(vec3 place) {
  float leaves = canopy_above(place).y;
  return leaves > 0.0 ? exp(-0.5 * leaves / max(sun_direction.z, 0.1)) : 1.0;
}

// Part of the sun that is seen past what the shadow maps hold: beyond them, past crowns.
// `extinction`: by leaves about the place, 1/m.
float mapped_sun_share(vec3 place, vec3 normal, float extinction) {
  for (int k = 0; k < shadow_count; ++k) {
    // Off the surface by what a texel hides; that, leaves within it do.
    vec3 lifted = place + normal * shadow_lifts[k];
    vec3 at = (shadow_matrices[k] * vec4(lifted, 1.0)).xyz;
    float edge = max(abs(at.x), abs(at.y));
    if (edge > 0.97 || at.z < 0.0 || at.z > 1.0) continue;
    float share = cascade_share(k, at) * exp(-extinction * shadow_texels[k]);
    if (k + 1 < shadow_count) return share;
    float beyond = smoothstep(0.8, 0.97, edge);
    return beyond > 0.0 ? mix(share, sun_through_canopy(place), beyond) : share;
  }
  return sun_through_canopy(place);
}

float sun_share(vec3 place, vec3 normal, float extinction) {
  float far = terrain_sun_share(place);
  return far > 0.0 ? min(far, mapped_sun_share(place, normal, extinction)) : 0.0;
}
float sun_share(vec3 place, vec3 normal) {
  return sun_share(place, normal, 0.0);
}

float sky_share(vec3 place, vec3 normal) {
  return under_canopy(place) * terrain_sky_share(place);
}
