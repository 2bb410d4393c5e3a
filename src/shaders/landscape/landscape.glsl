// A landscape in one pass: the ray of a pixel meets the land, then its shadow is found, then it is
// shaded, then comes the air before it, then clouds; one after the other, so that neighbouring
// pixels stay together in each loop. What water mirrors is another such ray.
#include "landscape/terrain.glsl"
#include "landscape/ground.glsl"
#include "landscape/woods.glsl"
#include "landscape/light.glsl"
#include "landscape/water.glsl"
#include "landscape/cloud_march.glsl"
#include "landscape/camera.glsl"

// Evenly spread over pixels and their neighbours (Jimenez, "Next generation post processing in Call
// of Duty: Advanced Warfare", SIGGRAPH 2014).
float pixel_noise(vec2 pixel) {
  return fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715))));
}

// Without a pattern, for steps so long that one would show.
float random_of(vec2 pixel) {
  return float(lattice_hash(uint(pixel.x), lattice_line(uint(pixel.y), 7u)) >> 8u) / 16777216.0;
}

// Sun, sky from above, and what sunlit land opposite the sun throws back, all Lambert.
vec3 shaded(vec3 albedo, vec3 normal, float open, float sunlit, Light light) {
  vec3 sun = light.sun * max(dot(normal, light.direction), 0.0) * sunlit;
  vec3 sky = light.sky * (0.5 + 0.5 * normal.z) * open;
  vec3 away = normalize(vec3(-light.direction.xy, 0.0) + vec3(1e-4, 0.0, 0.0));
  float facing = 0.35 + 0.65 * max(dot(normal, away), 0.0);
  vec3 bounce = 0.16 * albedo * (light.sun * max(light.direction.z, 0.0) + light.sky) * facing *
                (1.2 - normal.z) * open;
  return albedo / 3.1416 * (sun + sky + bounce);
}

// A place of the land as it is lit, under water where a share of it is (`water`: share, depth);
// `curve` is how far the planet's upright there leans.
Seen lit_place(Lit lit, vec2 water, vec2 place, vec2 curve, float pixel, vec3 direction,
               float sunlit, Light light, float time) {
  vec3 seen = shaded(lit.albedo, lit.normal, lit.open, lit.sunlit, light);
#if HAS_WATER
  // No crown is under water.
  water.x *= 1.0 - lit.crown;
  return with_water(seen, water, place, normalize(vec3(curve, 1.0)), pixel, direction, sunlit,
                    light, time);
#else
  return Seen(seen, vec3(0.0), vec3(0.0));
#endif
}

// The land at distance t along the ray, before the air.
Seen land_seen(LandRay ray, float t, vec2 across, vec2 up, float pixel_angle, Light light,
               float time) {
  vec2 place = place_along(ray, t);
  float pixel = pixel_angle * t;
  vec2 water = vec2(0.0);
  vec3 fine, wide, hollow;
  int looks = 3;
#if HAS_WOODS
  float bend = 0.0;
  if (pixel < TREES_UP_TO) looks = 4;
#endif
  for (int k = ZERO; k < looks; ++k) {
    float spacing = k == 0   ? max(finest_spacing(OCTAVES_NORMAL), 0.5 * pixel)
                    : k == 2 ? max(90.0, 4.0 * pixel)
                             : max(8.0, pixel);
    vec2 offset = vec2(0.0);
#if HAS_WOODS
    if (k == 3) offset = -way_through_trees(wide, ray.direction) * ray.direction.xy;
#endif
#if HAS_WATER
    vec2 wet;
    vec3 ground = terrain(place + offset, spacing, wet);
    if (k == 0) water = wet;
#else
    vec3 ground = terrain(place + offset, spacing);
#endif
    if (k == 0) fine = ground;
    else if (k == 1) wide = ground;
    else if (k == 2) hollow = ground;
#if HAS_WOODS
    else bend = ground.x - wide.x - dot(wide.yz, offset);
#endif
  }
  vec2 curve = ray.direction.xy * t / AIR.planet_radius;
  vec3 normal = normalize(vec3(curve - fine.yz, 1.0));

  float height = height_along(ray, t);
  LandRay sunward = LandRay(place, height + 0.3 + pixel, light.direction);
  float facing = dot(normal, light.direction);
  float sunlit = facing > 0.0 ? sun_shadow(sunward, pixel) : 0.0;
  sunlit *= cloud_shadow(place, height, light.direction, time);

  // A footprint at a silhouette would span to what lies behind.
  float longest = 4.0 * pixel / max(abs(dot(normal, ray.direction)), 0.1);
  across *= min(1.0, longest / max(length(across), 1e-6));
  up *= min(1.0, longest / max(length(up), 1e-6));
  float rise = fine.x - hollow.x;
  vec3 albedo = filtered_color(place, across, up, wide, fine, rise);
  Lit lit = Lit(albedo, normal, clamp(0.9 + 0.012 * rise, 0.4, 1.0), sunlit, 0.0);
#if HAS_WOODS
  lit = with_trees(lit, place, wide, bend, ray.direction, light.direction, pixel);
#endif
  return lit_place(lit, water, place, curve, pixel, ray.direction, sunlit, light, time);
}

// Clouds before what is at `reach`, and the air before them; nothing where the layer is not met.
AirLight clouds_before(LandRay ray, AirRay air, float reach, Light light, float start, float time) {
  AirLight none = AirLight(vec3(1.0), vec3(0.0));
#if CLOUD_STEPS > 0
  if (CLOUD_COVERAGE <= 0.0) return none;
  AirSpan span = span_in_layer(AIR, air.height, air.cosine, CLOUDS_HEIGHT,
                               CLOUDS_HEIGHT + CLOUDS_THICKNESS);
  if (!(min(span.end, reach) > span.begin) || span.begin > MAX_CLOUD_DISTANCE) return none;
  Light above = light_at(light.direction, CLOUDS_HEIGHT + 0.5 * CLOUDS_THICKNESS);
  vec3 on_ground = light.sky + max(light.direction.z, 0.0) * light.sun;
  vec3 around = (light.sky + AIR.ground_albedo * on_ground) / 6.2832;
  CloudLight clouds = clouds_met(
      landscape_clouds(), AIR, wind_place(ray.place, time), air, ray.direction, light.direction,
      min(reach, span.begin + 12.0 * CLOUDS_THICKNESS), above.sun, around, start,
      CloudSteps(CLOUD_STEPS, CLOUD_LIGHT_STEPS));
  if (clouds.transmittance > 0.999) return none;
  AirLight before = air_between(air, span.begin, max(ATMOS_STEPS / 2, 2));
  float near = 1.0 - smoothstep(0.6, 1.0, span.begin / MAX_CLOUD_DISTANCE);
  float hidden = near * (1.0 - clouds.transmittance);
  return AirLight(vec3(1.0 - hidden),
                  near * clouds.light * before.transmittance + before.light * hidden);
#else
  return none;
#endif
}

// All that is seen along a ray that meets the land at distance t, or nothing (t < 0).
Seen seen_along(LandRay ray, float t, vec2 across, vec2 up, float pixel_angle, Light light,
                float start, float time) {
  bool met = t > 0.0;
  AirRay air = AirRay(ray.height, ray.direction.z, light.direction.z,
                      dot(ray.direction, light.direction));
  Seen seen = Seen(vec3(0.0), vec3(0.0), vec3(0.0));
  if (met) seen = land_seen(ray, t, across, up, pixel_angle, light, time);
  else seen.radiance = behind_air(air, light);
  AirLight between = air_between(air, met ? t : 1e9, ATMOS_STEPS);
  AirLight clouds = clouds_before(ray, air, met ? t : 1e9, light, start, time);
  seen.radiance = (seen.radiance * between.transmittance + between.light) * clouds.transmittance +
                  clouds.light;
  seen.mirrored *= between.transmittance * clouds.transmittance;
  return seen;
}

vec3 landscape_color(vec2 pixel, vec2 resolution, vec4 mouse, float time) {
  View view = landscape_view(resolution, mouse, time);
  LandRay ray = LandRay(view.place, view.height, view_ray(view, pixel, resolution));
  float pixel_angle =
      2.0 * tan(0.5 * radians(FIELD_OF_VIEW)) / max(resolution.x, resolution.y);
  Light light = light_at(sun_direction(time), view.height);

  float t = march_terrain(ray, pixel_angle);
  vec2 place = ray.direction.xy * t;
  vec2 across = dFdx(place);
  vec2 up = dFdy(place);

  float start = random_of(pixel);
#if HAS_WATER
  vec3 seen = vec3(0.0);
  vec3 share = vec3(1.0);
  for (int k = ZERO; k < 2; ++k) {
    if (k > 0) {
      t = march_terrain(ray, pixel_angle);
      alone_footprint(ray.direction, pixel_angle * t, across, up);
    }
    Seen part = seen_along(ray, t, across, up, pixel_angle, light, start, time);
    seen += share * part.radiance;
    share *= part.mirrored;
    if (max(share.r, max(share.g, share.b)) < 0.002) break;
    ray = LandRay(place_along(ray, t), height_along(ray, t) + 0.05, part.way);
  }
#else
  vec3 seen = seen_along(ray, t, across, up, pixel_angle, light, start, time).radiance;
#endif
  vec3 shown = 1.0 - exp(-exposure_for(light) * max(seen, 0.0));
  return srgb_encoded(shown) + (pixel_noise(pixel + 17.0) - 0.5) / 255.0;
}

void mainImage(out vec4 color, in vec2 pixel) {
  color = vec4(landscape_color(pixel, iResolution.xy, iMouse, iTime), 1.0);
}
