// The light on surfaces (raster/scene_light.hpp), cd/m² and lx, linear Rec. 709.
#include "raster/shadows.glsl"
#include "raster/view.glsl"
#include "sky/sky_table.glsl"

const float light_pi = 3.14159265;

uniform vec3 sun_irradiance;  // lx, of a surface at right angles to it
uniform sampler2D sky_table;  // cd/m²
uniform vec3 sky_harmonics[9];  // of the irradiance, lx

// The sky without the sun, clouds among it.
vec3 sky_radiance(vec3 direction) {
  return texture(sky_table, sky_table_place(direction)).rgb;
}

// Irradiance by sky and ground around of a surface that looks towards n and sees all of them: R.
// Ramamoorthi, P. Hanrahan, "An efficient representation for irradiance environment maps", SIGGRAPH
// 2001. The constants of the bands are in the coefficients. For a mean of normals, shorter than 1,
// about the mean of their irradiances.
vec3 open_irradiance(vec3 n) {
  vec3 e = sky_harmonics[0] + sky_harmonics[1] * n.y + sky_harmonics[2] * n.z + sky_harmonics[3] * n.x +
           sky_harmonics[4] * (n.x * n.y) + sky_harmonics[5] * (n.y * n.z) +
           sky_harmonics[6] * (3.0 * n.z * n.z - dot(n, n)) + sky_harmonics[7] * (n.x * n.z) +
           sky_harmonics[8] * (n.x * n.x - n.y * n.y);
  return max(e, vec3(0.0));
}

// The same with what stands around in the way.
vec3 ambient_irradiance(vec3 place, vec3 normal) {
  return open_irradiance(normal) * sky_share(place, normal);
}

// Radiance that an opaque diffuse surface sends to the eye.
vec3 diffuse_radiance(vec3 place, vec3 normal, vec3 reflectance) {
  float facing = dot(normal, sun_direction);
  vec3 light = ambient_irradiance(place, normal);
  if (facing > 0.0) light += sun_irradiance * (facing * sun_share(place, normal));
  return reflectance * light / light_pi;
}

// The same of ground, which small plants stand on.
vec3 ground_radiance(vec3 place, vec3 normal, vec3 reflectance) {
  const float above = 0.5;  // m: where most of them end
  float facing = dot(normal, sun_direction);
  Undergrowth plants = undergrowth_at(place);
  vec3 light = ambient_irradiance(place, normal) * sky_through(plants);
  if (plants.leaves > 0.02 && sun_direction.z > 0.0) {
    float sun = sun_share(place + vec3(0.0, 0.0, above), vec3(0.0, 0.0, 1.0));
    light += sun_irradiance * (sun_direction.z * sun) * sun_scattered_by(plants);
  }
  if (facing > 0.0) light += sun_irradiance * (facing * sun_share(place, normal));
  return reflectance * light / light_pi;
}

// The same of a thin sheet, lit from both sides: leaves. `normal` looks towards the eye.
vec3 sheet_radiance(vec3 place, vec3 normal, vec3 reflectance, vec3 transmittance) {
  float facing = dot(normal, sun_direction);
  vec3 direct = sun_irradiance * abs(facing) * (facing > 0.0 ? reflectance : transmittance);
  vec3 ambient = reflectance * ambient_irradiance(place, normal) +
                 transmittance * ambient_irradiance(place, -normal);
  return (ambient + direct * sun_share(place, normal)) / light_pi;
}
