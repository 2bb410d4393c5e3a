// Sunlight within clouds: how much cloud lies between a place and the sun, baked in slices of the
// layer about the eye and carried along by the wind. Level k has a texel every light_cell · 2^k
// metres; its slices are layers k · light_slices and up, from the layer's base to its top.

uniform highp sampler2DArray cloud_lights;  // ∫ density ds towards the sun, m
uniform float light_cell;                   // m
uniform int light_levels;
uniform int light_slices;
uniform vec2 light_middle;  // the squares lie about it

const float light_margin = 12.0;  // texels that a square may stand off

float light_reach() {
  return (0.5 * float(textureSize(cloud_lights, 0).x) - light_margin) * light_cell;
}
float slice_height(int slice) {
  return CLOUDS_HEIGHT + CLOUDS_THICKNESS * (float(slice) + 0.5) / float(light_slices);
}

// From a place towards the sun until the layer ends, the planet's roundness in the sun's height.
float baked_cloud_light(vec2 place, float height, vec3 sun) {
  CloudLayer layer = landscape_clouds();
  float cosine = sun.z + dot(place - light_middle, sun.xy) / AIR.planet_radius;
  AirRay ray = AirRay(height, cosine, cosine, 1.0);
  AirSpan span = span_in_layer(AIR, ray.height, ray.cosine, CLOUDS_HEIGHT,
                               CLOUDS_HEIGHT + CLOUDS_THICKNESS);
  return cloud_along(layer, place, ray, sun, span.end, 2 * CLOUD_LIGHT_STEPS);
}

float light_level(vec2 place) {
  vec2 offset = abs(place - light_middle);
  float level = ceil(log2(max(max(offset.x, offset.y) / light_reach(), 1e-6)));
  return clamp(level, 0.0, float(light_levels - 1));
}

// The same, between slices and texels.
float tabled_cloud_light(vec2 place, float height) {
  float level = light_level(place);
  float v = (height - CLOUDS_HEIGHT) / CLOUDS_THICKNESS * float(light_slices) - 0.5;
  v = clamp(v, 0.0, float(light_slices - 1));
  float below = min(floor(v), float(light_slices - 2));
  vec2 at = (place / (light_cell * exp2(level)) + 0.5) / float(textureSize(cloud_lights, 0).x);
  float first = level * float(light_slices) + below;
  return mix(textureLod(cloud_lights, vec3(at, first), 0.0).r,
             textureLod(cloud_lights, vec3(at, first + 1.0), 0.0).r, v - below);
}

// Share of the sun at a place in the layer. What is near by, less than the table tells apart, is
// found anew.
float sunlit_share(CloudLayer layer, vec2 place, AirRay ray, vec3 sun) {
  AirSpan span = span_in_layer(AIR, ray.height, ray.cosine, CLOUDS_HEIGHT,
                               CLOUDS_HEIGHT + CLOUDS_THICKNESS);
  float level = light_level(place);
  float near = min(1.2 * light_cell * exp2(level), span.end);
  float sum = cloud_along(layer, place, ray, sun, near, 2);
  if (near < span.end)
    sum += tabled_cloud_light(place + near * sun.xy,
                              height_after(AIR, ray.height, ray.cosine, near));
  return exp(-(layer.clouds.scattering + layer.clouds.absorption) * sum);
}
