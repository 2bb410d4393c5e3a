#include "raster/plant_light.glsl"
#include "raster/plant_material.glsl"

uniform float crown_extinction;  // 1/m, among the leaves of the model

in vec3 place;
in vec3 model_place;
in vec3 normal;
in vec4 crown_light;
flat in vec3 own_tint;
flat in int material;
flat in float footprint_scale;

layout(location = 0) out vec4 color;

void main() {
  vec3 n = normalize(normal);
  vec3 to_eye = eye - place;
  if (dot(n, to_eye) < 0.0) n = -n;
  float footprint = pixel_size(place) * footprint_scale;
  vec3 reflectance = two_colors(plant_colors(material), model_place, footprint) * own_tint;
  vec3 transmittance = plant_transmission(material) * own_tint;
  keep_energy(reflectance, transmittance);
  float far_share = smoothstep(crown_light_range.x, crown_light_range.y, length(to_eye));
  color = vec4(
      crown_radiance(place, n, 0.0, reflectance, transmittance, plant_roughness(material),
                     crown_light, crown_extinction * footprint_scale, far_share),
      1.0);
}
