// The march of sky/atmosphere.hpp with light that the including shader gives:
//
//   LightInAir light_in_air(Atmosphere a, float height, float sun_cosine)
#include "sky/atmosphere.glsl"

LightInAir light_in_air(Atmosphere a, float height, float sun_cosine);

ScatteredSums march(Atmosphere a, AirRay ray, float reach, int steps) {
  AirSpan span = span_in_air(a, ray.height, ray.cosine);
  float whole = min(reach, span.end) - span.begin;
  ScatteredSums sums = no_scattering();
  if (!(whole > 0.0)) return sums;
  float from = span.begin;
  for (int k = 1; k <= steps; ++k) {
    float to = span.begin + whole * step_edge(k, steps);
    float middle = 0.5 * (from + to);
    float height = height_after(a, ray.height, ray.cosine, middle);
    add_stretch(a, air_column(a, ray.height, ray.cosine, from, to, 1),
                light_in_air(a, height, sun_cosine_after(a, ray, middle)), sums);
    from = to;
  }
  return sums;
}
