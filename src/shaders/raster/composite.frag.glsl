// What is drawn, with the air before it, the sky behind it, and clouds.
#include "raster/air.glsl"
#include "raster/picture.glsl"

uniform sampler2D surfaces;     // cd/m²
uniform sampler2D sky_table;    // without clouds
uniform sampler2D cloud_light;  // light, and what is left of the light behind
uniform bool has_clouds;
uniform vec3 sun_centre;  // cd/m²
uniform vec3 limb_exponent;
uniform float sun_chord;

in vec2 screen_place;
out vec4 result;

// What half floats hold.
const float brightest = 60000.0;

vec3 sun_disc(vec3 direction) {
  vec3 offset = direction - sun_direction;
  float r = dot(offset, offset) / (sun_chord * sun_chord);
  if (r >= 1.0) return vec3(0.0);
  return sun_centre * pow(vec3(sqrt(1.0 - r)), limb_exponent);
}

void main() {
  vec3 ray = view_ray(screen_place);
  float depth = view_depth(screen_place);
  float stretch = length(ray);
  vec3 direction = ray / stretch;
  vec3 light;
  if (depth < 0.0) {
    light = texture(sky_table, sky_table_place(direction)).rgb + sun_disc(direction);
  } else {
    AirLight air = air_light(eye, direction, depth * stretch);
    light = texture(surfaces, screen_place).rgb * air.transmittance + air.light;
  }
  if (has_clouds) {
    vec4 clouds = texture(cloud_light, screen_place);
    light = light * clouds.a + clouds.rgb;
  }
  // A light that is not finite is dark: min and max leave NaN to the driver.
  if (!(dot(light, vec3(1.0)) < 1e12)) light = vec3(0.0);
  result = vec4(clamp(light, 0.0, brightest), depth < 0.0 ? 0.0 : 1.0);
}
