// The air between the eye and what it sees, as Sky::air_light has it, and the sky behind
// (raster/sky_drawing.hpp).
#include "sky/atmosphere.glsl"
#include "sky/haze.glsl"
#include "sky/sky_table.glsl"

const int air_none = 0;
const int air_of_haze = 1;
const int air_of_planet = 2;

uniform int air_kind;
uniform Haze haze;
uniform sampler2D air_table;  // J of haze.hpp
uniform Atmosphere planet;
uniform sampler2D light_by_height;  // row 0 the sun's, row 1 that from all around
uniform vec3 sun_direction;         // unit

const int most_stretches = 8;

LightInAir planet_light(float height) {
  float v = sqrt(clamp(height / planet.air_thickness, 0.0, 1.0));
  float x = (v * 127.0 + 0.5) / 128.0;
  return LightInAir(texture(light_by_height, vec2(x, 0.25)).rgb,
                    texture(light_by_height, vec2(x, 0.75)).rgb);
}

// Twin of AirView::between.
AirLight planet_air(vec3 origin, vec3 direction, float reach) {
  AirRay ray = air_ray(planet, origin, direction, sun_direction);
  float end = min(reach, 2.0 * planet.planet_radius);
  int stretches = 1 + min(int(end / 4000.0), most_stretches - 1);
  ScatteredSums sums = no_scattering();
  float from = 0.0;
  for (int k = 0; k < stretches; ++k) {
    float to = end * step_edge(k + 1, stretches);
    float middle = height_after(planet, ray.height, ray.cosine, 0.5 * (from + to));
    add_stretch(planet, air_column(planet, ray.height, ray.cosine, from, to, 1),
                planet_light(middle), sums);
    from = to;
  }
  return with_phases(planet, sums, ray.to_sun, vec3(1.0));
}

AirLight air_light(vec3 origin, vec3 direction, float reach) {
  if (air_kind == air_none || !(reach > 0.0)) return AirLight(vec3(1.0), vec3(0.0));
  if (air_kind == air_of_planet) return planet_air(origin, direction, reach);
  vec3 passed = haze_transmittance(haze, origin, direction, reach);
  vec3 all = texture(air_table, sky_table_place(direction)).rgb;
  return AirLight(passed, all * (1.0 - passed));
}
