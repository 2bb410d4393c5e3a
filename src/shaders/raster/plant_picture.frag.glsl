// A picture of a plant from one side, for its cards (raster/plant_cards.hpp).
#include "raster/plant_material.glsl"
#include "raster/view.glsl"

in vec3 place;
in vec3 model_place;
in vec3 normal;
in vec4 crown_light;
flat in vec3 own_tint;
flat in int material;
flat in float footprint_scale;

layout(location = 0) out vec4 albedo;
layout(location = 1) out vec4 facing;  // normal in the model; which part is leaves
layout(location = 2) out vec4 let_in;

void main() {
  vec3 n = normalize(normal);
  if (dot(n, eye - place) < 0.0) n = -n;
  vec3 reflectance = two_colors(plant_colors(material), model_place, pixel_size(place)) * own_tint;
  float leaf = plant_transmission(material).g > 0.0 ? 1.0 : 0.0;
  albedo = vec4(reflectance, 1.0);
  facing = vec4(0.5 + 0.5 * n, leaf);
  let_in = vec4(0.5 + 0.25 * crown_light.xyz, crown_light.w);
}
