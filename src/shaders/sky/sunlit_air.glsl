// Twin of sky/sunlit_air.hpp: light in the air from two tables, textures whose texel centres are
// the nodes of SunlitAir's grids, with linear filtering, clamped at the edges.
//
// `transmittances`: columns by the distance to space, from the nearest to the farthest; rows by the
// distance to the horizon. `multiples`: columns by cosine of the sun, rows by height.
#include "sky/atmosphere.glsl"

// Bilinear between nodes, from coordinates in [0, 1].
vec3 looked_up(sampler2D table, vec2 u) {
  vec2 size = vec2(textureSize(table, 0));
  return textureLod(table, (clamp(u, 0.0, 1.0) * (size - 1.0) + 0.5) / size, 0.0).rgb;
}

float horizon_distance(Atmosphere a, float height) {
  return sqrt(max(0.0, height * (2.0 * a.planet_radius + height)));
}

vec2 transmittance_place(Atmosphere a, float height, float cosine) {
  float whole = horizon_distance(a, a.air_thickness);
  float rho = horizon_distance(a, height);
  float nearest = a.air_thickness - height;
  float farthest = rho + whole;
  float reach = distance_to_space(a, height, cosine);
  return vec2((reach - nearest) / (farthest - nearest), rho / whole);
}

vec2 multiple_place(Atmosphere a, float height, float sun_cosine) {
  return vec2(0.5 + 0.5 * sign(sun_cosine) * sqrt(abs(sun_cosine)),
              sqrt(height / a.air_thickness));
}

LightInAir sunlit_air(Atmosphere a, sampler2D transmittances, sampler2D multiples, float height,
                      float sun_cosine) {
  float h = clamp(height, 0.0, a.air_thickness);
  float seen = sun_above_edge(a, h, sun_cosine);
  vec3 sun = vec3(0.0);
  if (seen > 0.0) sun = seen * looked_up(transmittances, transmittance_place(a, h, sun_cosine));
  return LightInAir(sun, looked_up(multiples, multiple_place(a, h, sun_cosine)));
}

// The march of atmosphere.hpp in this light, SunlitAir::seen.
ScatteredSums seen_in_sunlit_air(Atmosphere a, sampler2D transmittances, sampler2D multiples,
                                 AirRay ray, float reach, int steps) {
  AirSpan span = span_in_air(a, ray.height, ray.cosine);
  float whole = min(reach, span.end) - span.begin;
  ScatteredSums sums = no_scattering();
  if (!(whole > 0.0)) return sums;
  float from = span.begin;
  for (int k = 1; k <= steps; ++k) {
    float to = span.begin + whole * step_edge(k, steps);
    float middle = 0.5 * (from + to);
    float height = height_after(a, ray.height, ray.cosine, middle);
    float sun_cosine = sun_cosine_after(a, ray, middle);
    add_stretch(a, air_column(a, ray.height, ray.cosine, from, to, 1),
                sunlit_air(a, transmittances, multiples, height, sun_cosine), sums);
    from = to;
  }
  return sums;
}
