// Land, sky and air of a pixel, times the exposure, without clouds.

// The least of h / (SUN_SOFTNESS t) along a ray to the sun, from t on.
float least_clearance(LandRay ray, float t, float finest) {
  Crossing above = crossing(AIR, ray.height, ray.direction.z, HIGHEST_LAND * TERRAIN_HEIGHT);
  float end = above.meets ? min(above.far_distance, MAX_RENDERING_DISTANCE) : 0.0;
  float least = 4.0;
  for (int i = ZERO; i < MAX_MARCHING_STEPS_SHADOW && t < end && least > -1.0; ++i) {
    float h = height_along(ray, t) - terrain(place_along(ray, t), max(finest, 0.004 * t)).x;
    least = min(least, h / (SUN_SOFTNESS * t));
    t += clamp(0.6 * h, 0.02 * t + finest, 0.1 * end);
  }
  return least;
}

// The sun's share by the baked horizon: the least of h / (SUN_SOFTNESS t) along the way to the sun
// was found from the baked land's height; a place higher or lower by d sees it d / (SUN_SOFTNESS t)
// larger, t being where it was found. Where what was baked around does not agree, at the edges of
// shadows, it is found anew.
float horizon_shadow(vec2 place, float height, float pixel, vec3 sun) {
  float first = ring_cell * exp2(float(horizon_first));
  float scale = float(horizon_size) / float(ring_size);
  float away = away_from_eye(place);
  float halvings = ceil(log2(max(away / (ring_reach(horizon_first) * scale), 1e-6)));
  int level = int(clamp(halvings, 0.0, float(horizon_levels - 1)));
  float cell = first * exp2(float(level));
  ivec2 low = ivec2(floor(place / cell));
  vec2 part = place / cell - vec2(low);
  float corners[4];
  float lowest = 4.0;
  float highest = -4.0;
  for (int k = ZERO; k < 4; ++k) {
    ivec2 texel = (low + ivec2(k & 1, k >> 1)) & (horizon_size - 1);
    vec3 found = texelFetch(ring_horizons, ivec3(texel, level), 0).xyz;
    corners[k] = clamp(found.x + (height - found.z) * found.y / SUN_SOFTNESS, -1.5, 1.5);
    lowest = min(lowest, corners[k]);
    highest = max(highest, corners[k]);
  }
  // What is near counts by the exact height: it is found anew.
  LandRay ray = LandRay(place, height, sun);
  float finest = max(finest_spacing(OCTAVES_SHADOW), pixel);
  float least = 4.0;
  float t = 2.0 * finest;
  for (int k = ZERO; k < 12; ++k) {
    float h = height_along(ray, t) - ring_height(place_along(ray, t), finest);
    least = min(least, h / (SUN_SOFTNESS * t));
    t *= 1.3;
  }
  float far = mix(mix(corners[0], corners[1], part.x), mix(corners[2], corners[3], part.x), part.y);
  if (highest - lowest > 0.3 && least > -1.0) far = least_clearance(ray, t, finest);
  least = clamp(min(least, far), -1.0, 1.0);
  return 0.25 * (1.0 + least) * (1.0 + least) * (2.0 - least);
}

// least, 1 / t, the height it holds for.
vec4 baked_horizon(vec2 place, float cell, vec3 sun) {
  float finest = max(finest_spacing(OCTAVES_SHADOW), cell);
  float start = ring_height(place, finest);
  LandRay ray = LandRay(place, start, sun);
  Crossing above = crossing(AIR, start, sun.z, HIGHEST_LAND * TERRAIN_HEIGHT);
  if (!above.meets || above.far_distance <= 0.0) return vec4(4.0, 0.0, start, 0.0);
  float end = min(above.far_distance, MAX_RENDERING_DISTANCE);
  float least = 4.0;
  float nearness = 0.0;
  float t = max(40.0 * finest_spacing(OCTAVES_SHADOW), 3.0 * cell);
  for (int i = ZERO; i < MAX_MARCHING_STEPS_SHADOW && t < end; ++i) {
    float h = height_along(ray, t) - ring_height(place_along(ray, t), max(finest, 0.004 * t));
    float here = h / (SUN_SOFTNESS * t);
    if (here < least) {
      least = here;
      nearness = 1.0 / t;
    }
    if (least < -4.0) break;
    t += clamp(0.6 * h, 0.02 * t + finest, 0.1 * end);
  }
  return vec4(max(least, -4.0), nearness, start, 0.0);
}

// Distance to the land, or -1. Where the baked land is met, Newton's rule finds the exact one; a
// ray that passes over it after all goes on. The march ends EPSILON t above the land, as march_terrain.
float fast_march(LandRay ray, float pixel_angle) {
  Crossing below = crossing(AIR, ray.height, ray.direction.z, HIGHEST_LAND * TERRAIN_HEIGHT);
  if (!below.meets || below.far_distance <= 0.0) return -1.0;
  float end = min(MAX_RENDERING_DISTANCE, below.far_distance);
  float finest = finest_spacing(OCTAVES);
  float t = march_rings(ray, max(below.near_distance, 0.5), end);
  float from = t;
  for (int k = ZERO; k < 24 && t > 0.0; ++k) {
    float spacing = max(finest, 0.7 * pixel_angle * t);
    vec3 ground = terrain(place_along(ray, t), spacing);
    float above = height_along(ray, t) - EPSILON * t - ground.x;
    if (abs(above) < 0.006 * pixel_angle * t) break;
    float rate = ray.direction.z + t / AIR.planet_radius - EPSILON -
                 dot(ground.yz, ray.direction.xy);
    float step = above / -min(rate, -0.05);
    t += clamp(step, -3.0 * spacing, 1.0 * spacing);
    // Passed over.
    float cell = ring_cell * exp2(float(level_reaching(away_from_eye(place_along(ray, t)))));
    if (t > from + 6.0 * cell) {
      t = march_rings(ray, t, end);
      from = t;
    }
  }
  return t > 0.0 && t < end ? max(t, 0.1) : -1.0;
}

Seen fast_land_seen(LandRay ray, float t, vec2 across, vec2 up, float pixel_angle, Light light,
                    float time) {
  vec2 place = place_along(ray, t);
  float pixel = pixel_angle * t;
  float finest = max(finest_spacing(OCTAVES_NORMAL), 0.5 * pixel);
  vec2 water = vec2(0.0);
#if HAS_WATER
  vec3 fine = terrain(place, finest, water);
#else
  vec3 fine = terrain(place, finest);
#endif
  vec3 wide = terrain(place, max(8.0, pixel));
  float hollow = terrain(place, max(90.0, 4.0 * pixel)).x;
  vec2 curve = ray.direction.xy * t / AIR.planet_radius;
  vec3 normal = normalize(vec3(curve - fine.yz, 1.0));
  float height = height_along(ray, t);
  float facing = dot(normal, light.direction);
  float sunlit = facing <= 0.0 ? 0.0
                               : horizon_shadow(place, height + 0.3 + pixel, pixel, light.direction);
  sunlit *= shade_of_clouds(place, height, light.direction, time);
  float longest = 4.0 * pixel / max(abs(dot(normal, ray.direction)), 0.1);
  across *= min(1.0, longest / max(length(across), 1e-6));
  up *= min(1.0, longest / max(length(up), 1e-6));
  float rise = fine.x - hollow;
  vec3 albedo = filtered_color(place, across, up, wide, fine, rise);
  Lit lit = Lit(albedo, normal, clamp(0.9 + 0.012 * rise, 0.4, 1.0), sunlit, 0.0);
#if HAS_WOODS
  float bend = 0.0;
  if (pixel < TREES_UP_TO) {
    vec2 offset = -way_through_trees(wide, ray.direction) * ray.direction.xy;
    bend = ring_height(place + offset, max(8.0, pixel)) - wide.x - dot(wide.yz, offset);
  }
  lit = with_trees(lit, place, wide, bend, ray.direction, light.direction, pixel);
#endif
  return lit_place(lit, water, place, curve, pixel, ray.direction, sunlit, light, time);
}

#if HAS_WATER
// What is seen from water along a ray, all the way to the sky. Such rays begin within what is added
// to the baked land: they are marched over the exact one.
vec3 fast_mirrored(LandRay ray, float pixel_angle, Light light, float start, float time) {
  float t = march_terrain(ray, pixel_angle);
  bool met = t > 0.0;
  AirRay air = AirRay(ray.height, ray.direction.z, light.direction.z,
                      dot(ray.direction, light.direction));
  vec3 surface;
  if (met) {
    vec2 across, up;
    alone_footprint(ray.direction, pixel_angle * t, across, up);
    surface = fast_land_seen(ray, t, across, up, pixel_angle, light, time).radiance;
  } else {
    surface = behind_air(air, light);
  }
  AirLight between = tabled_air_light(air, met ? t : 1e9, met ? 4 : 10);
  FastClouds clouds = fast_clouds_before(ray.place, air, ray.direction, met ? t : 1e9, light, start,
                                         time);
  return (surface * between.transmittance + between.light) * (1.0 - clouds.hidden) + clouds.light;
}
#endif

// Radiance times exposure, and the distance of the land or -1. Neighbours are two pixels apart.
vec4 fast_landscape(vec2 pixel, vec2 resolution, float time) {
  View view = seen_from(frame_view);
  LandRay ray = LandRay(view.place, view.height, view_ray(view, pixel, resolution));
  float pixel_angle = 2.0 * tan(0.5 * radians(FIELD_OF_VIEW)) / max(resolution.x, resolution.y);
  Light light = frame_light();
  float t = fast_march(ray, pixel_angle);
  bool met = t > 0.0;
  vec2 place = ray.direction.xy * t;
  vec2 across = 0.5 * dFdx(place);
  vec2 up = 0.5 * dFdy(place);
  AirRay air = AirRay(ray.height, ray.direction.z, light.direction.z,
                      dot(ray.direction, light.direction));
  vec3 seen;
  if (met) {
    Seen surface = fast_land_seen(ray, t, across, up, pixel_angle, light, time);
    AirLight between = tabled_air_light(air, t, 4);
#if HAS_WATER
    if (surface.mirrored.r > 0.002) {
      LandRay away = LandRay(place_along(ray, t), height_along(ray, t) + 0.05, surface.way);
      surface.radiance +=
          surface.mirrored * fast_mirrored(away, pixel_angle, light, cloud_start(pixel), time);
    }
#endif
    seen = surface.radiance * between.transmittance + between.light;
  } else {
    AirLight between = sky_air(air, ray.direction, light);
    seen = behind_air(air, light) * between.transmittance + between.light;
  }
  return vec4(min(frame_exposure() * max(seen, 0.0), 6e4), t);
}
