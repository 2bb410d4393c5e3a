// A plant of which some of the leaves are drawn (raster/plant_drawing.hpp).
#include "raster/plant_material.glsl"
#include "raster/plant_place.glsl"
#include "raster/view.glsl"

layout(location = 0) in vec3 vertex_position;
layout(location = 1) in uint vertex_identity;
layout(location = 2) in vec4 vertex_across;
layout(location = 3) in vec4 vertex_along;
layout(location = 4) in vec4 vertex_normal;
layout(location = 5) in vec4 vertex_light;
layout(location = 6) in vec4 plant_at;    // m; w: scale
layout(location = 7) in vec4 plant_turn;  // quaternion
layout(location = 8) in vec4 plant_share;  // of leaves; part drawn; place in textures
layout(location = 9) in uvec2 plant_bits;
layout(location = 10) in vec3 plant_growth;  // in area; leaf area of others around, their height

uniform int first_material;
uniform mat4 from_eye;  // view_projection of what is relative to the eye

#ifndef DEPTH_ONLY
out vec3 place;          // m
out vec3 model_place;    // m, in the model and in its piece of the texture
out vec3 normal;
out vec4 crown_light;    // share of light let through by the crown: moment in the world, mean
flat out vec3 own_tint;
flat out int material;
flat out float footprint_scale;
#endif

void main() {
  vec3 p = plant_place(vertex_position, vertex_across, vertex_along, plant_share.x, plant_share.y,
                       plant_growth.x);
  vec3 at = plant_at.xyz - eye + plant_at.w * turned_by(plant_turn, p);
  gl_Position = from_eye * vec4(at, 1.0);
#ifndef DEPTH_ONLY
  place = eye + at;
  model_place = vertex_position + 100.0 * vec3(plant_share.zw, 0.0);
  normal = turned_by(plant_turn, vertex_normal.xyz);
  crown_light = vec4(turned_by(plant_turn, vertex_light.xyz * (127.0 / 63.0)), vertex_light.w);
  // Among others of its size the sky is seen through those above (Monsi, Saeki, 1953).
  float above = plant_growth.y * clamp(1.0 - plant_at.w * p.z / plant_growth.z, 0.0, 1.0);
  crown_light *= exp(-0.8 * above);
  material = first_material + int(vertex_identity >> 24u);
  footprint_scale = 1.0 / plant_at.w;
  // Fewer leaves differ less, so that what is seen of many together differs as before (Cook et al.,
  // 2007, section 4).
  vec2 variation = plant_variation(material);
  own_tint = material_tint(plant_share.zw, variation.y);
  own_tint *= material_tint(random_bits(plant_bits, vertex_identity & 0xffffffu),
                            variation.x * sqrt(min(1.0, plant_share.x)));
#endif
}
