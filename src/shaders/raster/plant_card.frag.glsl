#ifndef DEPTH_ONLY
#include "raster/plant_light.glsl"
#include "raster/plant_material.glsl"
#endif
#include "raster/plant_place.glsl"

in vec3 place;
in vec2 card_place;
flat in vec4 turn;
flat in vec4 individual;
flat in vec4 pictures;

uniform vec4 card_shape;
uniform vec3 card_transmission;
uniform float card_roughness;
uniform int card_layer;
uniform mediump sampler2DArray card_albedo;
uniform mediump sampler2DArray card_normal;
uniform mediump sampler2DArray card_light;

#ifndef DEPTH_ONLY
layout(location = 0) out vec4 color;
#endif

const vec2 card_elevations = vec2(0.08, 0.75);

uniform float card_frame;  // another number for each frame

// Even over [0, 1) among neighbours and over frames, another for each plant: noise after Jimenez,
// 2014, moved on by the golden ratio.
float card_noise(vec2 pixel, vec2 own, float step) {
  vec2 at = pixel + floor(64.0 * own);
  return fract(52.9829189 * fract(dot(at, vec2(0.06711056, 0.00583715))) + step * card_frame);
}

// A tall plant's picture is squeezed: the finer direction counts nearly alone, and the mean over
// frames does the rest.
float sharper(float longest, float own) {
  return own > 0.0 ? clamp(longest / own, 0.3, 1.0) : 1.0;
}

// Nothing outside the picture. `at`, `dx`, `dy`: where the other textures are looked up.
vec4 card_seen(float row, float column, out vec3 at, out vec2 dx, out vec2 dy) {
  float elevation = row > 0.0 ? card_elevations.y : card_elevations.x;
  float tall = 0.5 * (card_shape.z - card_shape.y) * cos(elevation) + card_shape.x * sin(elevation);
  vec2 size = vec2(card_shape.x, tall);
  vec2 uv = 0.5 + 0.5 * card_place / size;
  float number = row * 8.0 + column;
  vec2 corner = vec2(mod(number, 4.0), floor(number / 4.0));
  at = vec3(0.25 * (corner + clamp(uv, 0.0, 1.0)), float(card_layer));
  dx = 0.125 * dFdx(card_place) / size;
  dy = 0.125 * dFdy(card_place) / size;
  float least = min(length(dx), length(dy));
  dx *= sharper(1.5 * least, length(dx));
  dy *= sharper(1.5 * least, length(dy));
  vec4 seen = textureGrad(card_albedo, at, dx, dy);
  return any(greaterThan(abs(uv - 0.5), vec2(0.5))) ? vec4(0.0) : seen;
}

void main() {
  vec2 pixel = floor(gl_FragCoord.xy);
  if (card_noise(pixel.yx, individual.wz, 0.7548777) >= pictures.w) discard;
  float u = card_noise(pixel + 17.0, individual.zw, 0.5698403);
  // Soft steps: a picture is alone about its own direction, as two at once blur each other.
  float other = smoothstep(0.35, 0.65, pictures.y);
  float row = fract(u * 7.31 + 0.37) < smoothstep(0.3, 0.7, pictures.z) ? 1.0 : 0.0;
  float column = mod(pictures.x + (u < other ? 1.0 : 0.0), 8.0);
  vec3 at;
  vec2 dx, dy;
  vec4 seen = card_seen(row, column, at, dx, dy);
#ifdef DEPTH_ONLY
  // Between two pictures a crown is as dense as either: a mean would let the sun through.
  seen.a = max(seen.a, card_seen(1.0 - row, column, at, dx, dy).a);
#endif
  if (seen.a <= 0.0 || seen.a <= card_noise(pixel, individual.zw, 0.6180340)) discard;
#ifndef DEPTH_ONLY
  vec4 facing = textureGrad(card_normal, at, dx, dy);
  vec4 let_in = textureGrad(card_light, at, dx, dy);
  vec3 mean = turned_by(turn, 2.0 * facing.xyz - 1.0);
  // Of leaves that look everywhere the mean has length 2/3.
  float spread = clamp(3.0 * (1.0 - length(mean)), 0.0, 1.0);
  vec4 crown_light = vec4(turned_by(turn, 4.0 * let_in.xyz - 2.0), let_in.w);
  vec3 reflectance = seen.rgb * seen.rgb * material_tint(individual.zw, card_shape.w);
  vec3 transmittance = reflectance * card_transmission * facing.a;
  color = vec4(
      crown_radiance(place, mean, spread, reflectance, transmittance, card_roughness * facing.a,
                     crown_light, 0.0, 1.0),
      1.0);
#endif
}
