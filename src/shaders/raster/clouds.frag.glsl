// Clouds before what is drawn: light, and what is left of the light behind.
#include "raster/air.glsl"
#include "raster/interleaved_noise.glsl"
#include "raster/picture.glsl"
#include "sky/clouds.glsl"

uniform Clouds clouds;
uniform vec3 sun_on_clouds;  // lx
uniform vec3 sky_on_clouds;  // cd/m²
uniform int cloud_steps;
uniform int cloud_light_steps;
uniform float start_turn;  // shifts the samples, another number for each frame

in vec2 screen_place;
out vec4 result;

const float farthest_cloud = 1.2e5;  // m

void main() {
  vec3 ray = view_ray(screen_place);
  float depth = view_depth(screen_place);
  float stretch = length(ray);
  vec3 direction = ray / stretch;
  float reach = depth < 0.0 ? farthest_cloud : min(depth * stretch, farthest_cloud);
  AirRay air = air_ray(planet, eye, direction, sun_direction);
  AirSpan span = span_in_layer(planet, air.height, air.cosine, clouds.height,
                               clouds.height + clouds.thickness);
  result = vec4(0.0, 0.0, 0.0, 1.0);
  if (!(min(reach, span.end) > span.begin)) return;
  float start = fract(interleaved_noise(gl_FragCoord.xy) + start_turn);
  CloudLight seen = clouds_seen(cloud_layer(clouds), planet, eye.xy, air, direction, sun_direction,
                                reach, sun_on_clouds, sky_on_clouds, start,
                                CloudSteps(cloud_steps, cloud_light_steps));
  AirLight before = air_light(eye, direction, span.begin);
  result = vec4(seen.light * before.transmittance + before.light * (1.0 - seen.transmittance),
                seen.transmittance);
}
