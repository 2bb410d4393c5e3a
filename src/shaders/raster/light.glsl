// The light on surfaces (raster/scene_light.hpp), cd/m² and lx, linear Rec. 709.
#include "raster/view.glsl"

const float light_pi = 3.14159265;

uniform vec3 sun_direction;   // unit, towards the sun
uniform vec3 sun_irradiance;  // lx, of a surface at right angles to it
uniform vec3 sky_irradiance;  // lx, of a horizontal surface

// Part of the sun that a place sees, in [0, 1].
float sun_share(vec3 place, vec3 normal) {
  return 1.0;
}

// Irradiance by sky and ground of a surface that looks towards `normal`.
vec3 ambient_irradiance(vec3 normal) {
  return sky_irradiance * (0.5 + 0.5 * normal.z);
}

// What the eye sees of an opaque diffuse surface, before the air between.
vec3 diffuse_radiance(vec3 place, vec3 normal, vec3 reflectance) {
  float facing = max(0.0, dot(normal, sun_direction));
  vec3 light = ambient_irradiance(normal);
  if (facing > 0.0) light += sun_irradiance * (facing * sun_share(place, normal));
  return reflectance * light / light_pi;
}

// The same of a thin sheet, lit from both sides: leaves. `normal` looks towards the eye.
vec3 sheet_radiance(vec3 place, vec3 normal, vec3 reflectance, vec3 transmittance) {
  float facing = dot(normal, sun_direction);
  vec3 direct = sun_irradiance * abs(facing) * (facing > 0.0 ? reflectance : transmittance);
  vec3 ambient = reflectance * ambient_irradiance(normal) + transmittance * ambient_irradiance(-normal);
  return (ambient + direct * sun_share(place, normal)) / light_pi;
}

// What is left of a surface's radiance at the eye, and what the air adds.
vec3 through_air(vec3 radiance, vec3 place) {
  return radiance;
}
