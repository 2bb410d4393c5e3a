// Materials of plants, five texels of a row for each: what SurfaceMaterial has.
#include "render/material.glsl"

uniform sampler2D plant_materials;

TwoColors plant_colors(int row) {
  vec4 a = texelFetch(plant_materials, ivec2(0, row), 0);
  vec4 b = texelFetch(plant_materials, ivec2(1, row), 0);
  vec4 c = texelFetch(plant_materials, ivec2(2, row), 0);
  vec4 d = texelFetch(plant_materials, ivec2(3, row), 0);
  uint seed = (uint(d.z) << 16u) | uint(d.w);
  return TwoColors(a.rgb, b.rgb, a.a, b.a, c.a, seed);
}
vec3 plant_transmission(int row) {
  return texelFetch(plant_materials, ivec2(2, row), 0).rgb;
}
// Amounts of difference between leaves, and between individuals.
vec2 plant_variation(int row) {
  return texelFetch(plant_materials, ivec2(3, row), 0).xy;
}
float plant_roughness(int row) {
  return texelFetch(plant_materials, ivec2(4, row), 0).x;
}
