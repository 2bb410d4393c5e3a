// Water: a body through which the bed shows, under a surface with small waves that mirrors.

// What is seen at a place, before the air: what it sends by itself, and how it mirrors.
struct Seen {
  vec3 radiance;
  vec3 mirrored;  // share of what is seen in it
  vec3 way;       // where that is seen
};

#if HAS_WATER
const float WAVE_SIZE = 1.2;  // m

// The slope of waves that drift both ways. The largest are left in even where a pixel covers many
// of them: it shows one at random, whose mean over pixels and pictures is what all of them mirror.
vec2 wave_slope(vec2 place, float pixel, float time) {
  pixel = min(pixel, 0.3 * WAVE_SIZE);
  vec2 slope = WAVE_SIZE * patches_slope(place + 0.35 * time, WAVE_SIZE, pixel, 4, 61u).yz;
  slope += 1.6 * WAVE_SIZE *
           patches_slope(place - vec2(0.5, 0.2) * time, 1.6 * WAVE_SIZE, pixel, 3, 65u).yz;
  return WATER_RIPPLES * slope;
}

float fresnel(float cosine) {
  float c = 1.0 - clamp(cosine, 0.0, 1.0);
  return 0.02 + 0.98 * c * c * c * c * c;
}

// The sun in waves that are too small to be seen one by one (Beckmann's distribution of slopes).
vec3 sun_in_waves(vec3 normal, vec3 to_eye, float pixel, float sunlit, Light light) {
  vec3 half_way = normalize(to_eye + light.direction);
  float cosine = max(dot(normal, half_way), 1e-3);
  float hidden = smoothstep(0.1 * WAVE_SIZE, 2.0 * WAVE_SIZE, pixel);
  float alpha = max(0.02, WATER_ROUGHNESS * WATER_ROUGHNESS);
  float m2 = alpha * alpha + 2.0 * WATER_RIPPLES * WATER_RIPPLES * hidden;
  float c2 = cosine * cosine;
  float share = exp((c2 - 1.0) / (c2 * m2)) / (3.1416 * m2 * c2 * c2);
  float facing = smoothstep(0.0, 0.02, light.direction.z);
  return light.sun * sunlit * facing * fresnel(dot(to_eye, half_way)) * share /
         (4.0 * max(dot(normal, to_eye), 0.1));
}

// A place of which a share is under water of this depth (`water`), without which it looks as
// `bed`, lit alike. `up` is the planet's there.
Seen with_water(vec3 bed, vec2 water, vec2 place, vec3 up, float pixel, vec3 direction,
                float sunlit, Light light, float time) {
  if (water.x <= 0.0) return Seen(bed, vec3(0.0), vec3(0.0));
  vec3 normal = normalize(up + vec3(-wave_slope(place, pixel, time), 0.0));
  vec3 to_eye = -direction;
  float mirrored = fresnel(max(dot(normal, to_eye), dot(up, to_eye)));
  vec3 body = WATER_COLOR / 3.1416 *
              (light.sun * max(dot(up, light.direction), 0.0) * sunlit + light.sky);
  // Light goes down to the bed and up again.
  vec3 deep = mix(body, bed, exp(-water.y / WATER_CLARITY));
  vec3 radiance = (1.0 - mirrored) * deep + sun_in_waves(normal, to_eye, pixel, sunlit, light);
  vec3 way = reflect(direction, normal);
  // From the eye's upright to that of the place.
  way = vec3(way.xy - up.xy * way.z, dot(way, up));
  way.z = max(way.z, 0.01);
  return Seen(mix(bed, radiance, water.x), vec3(water.x * mirrored), normalize(way));
}

// What a pixel covers of the land that its ray meets, where no neighbours tell.
void alone_footprint(vec3 direction, float pixel, out vec2 across, out vec2 up) {
  vec2 ahead = normalize(direction.xy + vec2(1e-5, 0.0));
  across = pixel * vec2(ahead.y, -ahead.x);
  up = pixel / max(abs(direction.z), 0.25) * ahead;
}
#endif
