// The ground: colours and normal of a pixel's footprint, lit by sun and sky.
#include "raster/light.glsl"
#include "render/ground.glsl"

uniform vec2 ground_anchor;  // world place of the anchor, m
uniform vec2 terrain_eye;    // m from the anchor

in vec2 place;
in float height;
in float lift;

out vec4 color;

const float coat_reflectance = 0.04;  // of a dielectric at right angles

float schlick(float cosine) {
  float m = 1.0 - clamp(cosine, 0.0, 1.0);
  return coat_reflectance + (1.0 - coat_reflectance) * m * m * m * m * m;
}

float smith_lambda(float cosine, float alpha) {
  float c2 = cosine * cosine;
  return 0.5 * (sqrt(1.0 + alpha * alpha * (1.0 - c2) / c2) - 1.0);
}

// Metres that a pixel covers: its width, as in the path tracer. Along grazing views it is longer, and
// the mean over frames has what is finer than that; up to a point, for the sake of views that move.
float pixel_footprint() {
  float longest = max(length(dFdx(place)), length(dFdy(place)));
  float wide = pixel_angle * length(vec3(terrain_eye - place, eye.z - height));
  return max(wide, 0.1 * longest);
}

// The sun's glint and the sky's reflection in a clear coat (render/bsdf.hpp), and what it leaves of
// the light below.
vec3 coated(vec3 below, vec3 world, vec3 normal, vec3 flat_normal, vec3 to_eye, float roughness) {
  float facing = max(dot(normal, to_eye), 1e-3);
  vec3 mirrored = reflect(-to_eye, normal);
  mirrored.z = max(mirrored.z, 0.01);
  float f = schlick(facing);
  vec3 light = (1.0 - f) * below;
  // What is mirrored down through the triangle is dark: a face of water between two levels.
  if (dot(mirrored, flat_normal) > 0.0) light += f * sky_radiance(normalize(mirrored));
  float sun_facing = dot(normal, sun_direction);
  if (sun_facing <= 0.0) return light;
  float alpha = max(0.02, roughness * roughness);
  vec3 half_way = normalize(sun_direction + to_eye);
  float cosine = dot(half_way, normal);
  float a2 = alpha * alpha;
  float d = cosine * cosine * (a2 - 1.0) + 1.0;
  float ggx = a2 / (light_pi * d * d);
  float g = 1.0 / (1.0 + smith_lambda(facing, alpha) + smith_lambda(sun_facing, alpha));
  float glint = schlick(dot(half_way, to_eye)) * ggx * g / (4.0 * facing);
  return light + sun_irradiance * (glint * sun_share(world, normal));
}

void main() {
  GroundSurface s = ground_surface(place, lift, pixel_footprint());
  // Far away the triangles cut corners: what lies below the land itself would be in its shade.
  vec3 world = vec3(place + ground_anchor, max(height, s.height));
  vec3 to_eye = normalize(vec3(terrain_eye - place, eye.z - height));
  // A normal that faces away, as at silhouettes, is brought to where the eye sees it.
  float facing = dot(s.normal, to_eye);
  if (facing < 0.01) s.normal = normalize(s.normal + (0.01 - facing) * to_eye);
  vec3 light = ground_radiance(world, s.normal, s.reflectance);
  vec3 drawn = vec3(place, height);
  vec3 flat_normal = cross(dFdx(drawn), dFdy(drawn));
  flat_normal *= flat_normal.z < 0.0 ? -1.0 : 1.0;
  if (s.roughness > 0.0)
    light = coated(light, world, s.normal, flat_normal, to_eye, s.roughness);
  color = vec4(light, 1.0);
}
