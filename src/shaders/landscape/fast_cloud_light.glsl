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

// The finest level that a place is in, and at its edges some of the next.
float light_level(vec2 place) {
  vec2 offset = abs(place - light_middle);
  float halvings = log2(max(max(offset.x, offset.y) / light_reach(), 1e-6));
  float level = max(ceil(halvings), 0.0);
  return min(level + smoothstep(level - 0.3, level, halvings), float(light_levels - 1));
}

// The same, between slices and texels. Between slices by the quadratic B-spline, as the kinks of a
// linear one are seen as level stripes in near clouds; nothing is left at the layer's top.
float tabled_cloud_light(vec2 place, float height, float level) {
  float last = float(light_slices - 1);
  float v = (height - CLOUDS_HEIGHT) / CLOUDS_THICKNESS * float(light_slices) - 0.5;
  v = clamp(v, 0.0, last + 0.499);
  float middle = floor(v + 0.5);
  float t = v - middle;
  vec3 weights = vec3(0.5 * (0.5 - t) * (0.5 - t), 0.75 - t * t, 0.5 * (0.5 + t) * (0.5 + t));
  vec2 at = (place / (light_cell * exp2(level)) + 0.5) / float(textureSize(cloud_lights, 0).x);
  float first = level * float(light_slices);
  float below = textureLod(cloud_lights, vec3(at, first + max(middle - 1.0, 0.0)), 0.0).r;
  float here = textureLod(cloud_lights, vec3(at, first + middle), 0.0).r;
  float above = middle < last
                    ? textureLod(cloud_lights, vec3(at, first + middle + 1.0), 0.0).r
                    : -here;
  return dot(weights, vec3(below, here, above));
}

// Share of the sun at a place in the layer. What is near by, less than the table tells apart, is
// found anew.
float sunlit_share(CloudLayer layer, vec2 place, AirRay ray, vec3 sun) {
  AirSpan span = span_in_layer(AIR, ray.height, ray.cosine, CLOUDS_HEIGHT,
                               CLOUDS_HEIGHT + CLOUDS_THICKNESS);
  float level = light_level(place);
  float near = min(1.2 * light_cell * exp2(level), span.end);
  float sum = cloud_along(layer, place, ray, sun, near, 2);
  if (near < span.end) {
    vec2 at = place + near * sun.xy;
    float height = height_after(AIR, ray.height, ray.cosine, near);
    float coarser = fract(level);
    float beyond = tabled_cloud_light(at, height, floor(level));
    if (coarser > 0.0)
      beyond = mix(beyond, tabled_cloud_light(at, height, floor(level) + 1.0), coarser);
    sum += beyond;
  }
  return exp(-(layer.clouds.scattering + layer.clouds.absorption) * sum);
}
