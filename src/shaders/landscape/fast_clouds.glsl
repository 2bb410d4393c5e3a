// Clouds of a quarter of the pixels each frame, and their history.

uniform highp sampler2D land_picture;     // radiance times exposure; alpha: distance, -1 for sky
uniform sampler2D new_clouds;             // of a pixel in four: light, transmittance
uniform highp sampler2D new_distances;    // m
uniform sampler2D cloud_history;
uniform bool has_history;
uniform bool still;     // the camera stands
uniform ivec2 turn;     // which of each four pixels is new
uniform float start_turn;
uniform float share;     // of what is new

// cloud_transmittance towards the sun, where there are clouds and until nothing is left.
float sunlit_share(CloudLayer layer, vec2 place, AirRay ray, vec3 sun) {
  Clouds c = layer.clouds;
  float extinction = c.scattering + c.absorption;
  AirSpan span = span_in_layer(AIR, ray.height, ray.cosine, c.height, c.height + c.thickness);
  float whole = span.end - span.begin;
  if (!(whole > 0.0)) return 1.0;
  float sum = 0.0;
  float from = span.begin;
  for (int k = 1; k <= CLOUD_LIGHT_STEPS; ++k) {
    float to = span.begin + whole * step_edge(k, CLOUD_LIGHT_STEPS);
    float s = 0.5 * (from + to);
    vec2 at = place + s * sun.xy;
    if (maybe_cloud(at))
      sum += (to - from) * cloud_density(layer, at, height_after(AIR, ray.height, ray.cosine, s));
    if (extinction * sum > 40.0) break;
    from = to;
  }
  return exp(-extinction * sum);
}

// clouds_met (landscape/cloud_march.glsl), but nothing is worked out where no cloud stands; `away`
// is the mean distance of what is seen, m.
CloudLight fast_clouds_met(CloudLayer layer, vec2 place, AirRay ray, vec3 direction, Light light,
                           float reach, vec3 sky_radiance, float start, out float away) {
  Clouds c = layer.clouds;
  CloudLight seen = CloudLight(1.0, vec3(0.0));
  AirSpan span = span_in_layer(AIR, ray.height, ray.cosine, c.height, c.height + c.thickness);
  float end = min(reach, span.end);
  float extinction = c.scattering + c.absorption;
  away = span.begin;
  if (!(end > span.begin) || !(extinction > 0.0)) return seen;
  float longest = (end - span.begin) / float(max(CLOUD_STEPS, 1));
  float shortest = min(longest, max(0.6 / extinction, 5e-4 * span.begin));
  float stride = longest;
  float s = span.begin + start * longest;
  float weights = 0.0;
  away = 0.0;
  for (int k = ZERO; k < 3 * CLOUD_STEPS && s < end && seen.transmittance > 0.01; ++k) {
    float height = height_after(AIR, ray.height, ray.cosine, s);
    vec2 at = place + s * direction.xy;
    float dense = maybe_cloud(at) ? cloud_density(layer, at, height) : 0.0;
    if (!(dense > 0.0)) {
      s += stride;
      stride = min(1.4 * stride, longest);
      continue;
    }
    if (stride > 1.5 * shortest && seen.transmittance > 0.6) {
      float back = min(0.75 * stride, s - span.begin);
      stride = max(0.25 * stride, shortest);
      s -= back;
      if (back > 0.0) continue;
    }
    float sun_cosine = sun_cosine_after(AIR, ray, s);
    float lit = sunlit_share(layer, at, AirRay(height, sun_cosine, sun_cosine, 1.0),
                             light.direction);
    float passed = exp(-extinction * dense * stride);
    float v = (height - c.height) / c.thickness;
    vec3 around = sky_radiance * mix(0.55, 1.15, clamp(v, 0.0, 1.0));
    vec3 source = (scattered_in_cloud(c, ray.to_sun, lit) * sun_on_clouds() + around) *
                  (c.scattering / extinction);
    float weight = seen.transmittance * (1.0 - passed);
    seen.light += weight * source;
    seen.transmittance *= passed;
    away += weight * s;
    weights += weight;
    s += stride;
    stride = min(1.25 * stride, longest);
  }
  away = weights > 0.0 ? away / weights : 0.5 * (span.begin + span.end);
  seen.light /= max(1.0 - seen.transmittance, 1e-3);
  seen.transmittance = max(0.0, (seen.transmittance - 0.01) / 0.99);
  seen.light *= 1.0 - seen.transmittance;
  return seen;
}

// Light times exposure; transmittance; distance goes out beside.
vec4 fast_clouds(vec2 pixel, vec2 resolution, float reach, float time, out float distance_to) {
  distance_to = 1e5;
  vec4 nothing = vec4(0.0, 0.0, 0.0, 1.0);
#if CLOUD_STEPS > 0
  if (CLOUD_COVERAGE <= 0.0) return nothing;
  View view = seen_from(frame_view);
  vec3 direction = view_ray(view, pixel, resolution);
  Light light = frame_light();
  AirRay air = AirRay(view.height, direction.z, light.direction.z, dot(direction, light.direction));
  AirSpan span = span_in_layer(AIR, air.height, air.cosine, CLOUDS_HEIGHT,
                               CLOUDS_HEIGHT + CLOUDS_THICKNESS);
  if (!(min(span.end, reach) > span.begin) || span.begin > MAX_CLOUD_DISTANCE) return nothing;
  distance_to = span.begin;
  vec3 on_ground = light.sky + max(light.direction.z, 0.0) * light.sun;
  vec3 around = (light.sky + AIR.ground_albedo * on_ground) / 6.2832;
  float start = fract(random_of(pixel) + start_turn);
  CloudLight clouds = fast_clouds_met(
      landscape_clouds(), wind_place(view.place, time), air, direction, light,
      min(reach, span.begin + 12.0 * CLOUDS_THICKNESS), around, start, distance_to);
  if (clouds.transmittance > 0.999) return nothing;
  AirLight before = tabled_air_light(air, span.begin, 5);
  float far = 1.0 - smoothstep(0.6, 1.0, span.begin / MAX_CLOUD_DISTANCE);
  float hidden = 1.0 - clouds.transmittance;
  vec3 seen = clouds.light * before.transmittance + before.light * hidden;
  return vec4(min(frame_exposure() * far * seen, 6e4), 1.0 - far * hidden);
#else
  return nothing;
#endif
}

// Where what is seen now at a pixel, so far away and moved by the wind, was seen last; in pixels.
vec2 last_pixel(vec2 pixel, vec2 resolution, float away, float time) {
  View view = seen_from(frame_view);
  View last = seen_from(last_view);
  float last_time = texelFetch(last_view, ivec2(0, 0), 0).w;
  vec3 to = view_ray(view, pixel, resolution) * away;
  to.xy += view.place - last.place - vec2(WIND_SPEED * (time - last_time), 0.0);
  to.z += view.height - last.height;
  float depth = dot(to, last.forward);
  if (depth <= 0.0) return vec2(-1e4);
  float half_width = depth * tan(0.5 * radians(FIELD_OF_VIEW));
  vec2 p = vec2(dot(to, last.right), dot(to, last.up)) / half_width;
  return 0.5 * (p * max(resolution.x, resolution.y) + resolution);
}

vec4 resolved_clouds(vec2 pixel, vec2 resolution, float time) {
  ivec2 at = ivec2(pixel);
  ivec2 last_cell = textureSize(new_clouds, 0) - 1;
  ivec2 cell = clamp((at - turn + 1) / 2, ivec2(0), last_cell);
  bool fresh = all(equal((at - turn) & 1, ivec2(0))) && all(lessThanEqual(2 * cell + turn, at));
  vec2 between = (pixel - 0.5 - vec2(turn)) * 0.5;
  vec4 around = textureLod(new_clouds, (between + 0.5) / vec2(last_cell + 1), 0.0);
  vec4 now = fresh ? texelFetch(new_clouds, cell, 0) : around;
  if (!has_history) return now;
  float away = textureLod(new_distances, (between + 0.5) / vec2(last_cell + 1), 0.0).r;
  vec2 then = last_pixel(pixel, resolution, away, time);
  if (any(lessThan(then, vec2(0.0))) || any(greaterThan(then, resolution))) return now;
  vec4 before = textureLod(cloud_history, then / resolution, 0.0);
  if (!still) {
    ivec2 middle = clamp(ivec2(floor(between + 0.5)), ivec2(0), last_cell);
    // Of land or of sky, as this one is.
    bool is_land = texelFetch(land_picture, at, 0).a > 0.0;
    ivec2 last_texel = textureSize(land_picture, 0) - 1;
    vec4 low = vec4(1e5);
    vec4 high = vec4(-1e5);
    for (int j = -1; j <= 1; ++j)
      for (int i = -1; i <= 1; ++i) {
        ivec2 c = clamp(middle + ivec2(i, j), ivec2(0), last_cell);
        ivec2 texel = min(2 * c + turn, last_texel);
        if ((texelFetch(land_picture, texel, 0).a > 0.0) != is_land) continue;
        vec4 near = texelFetch(new_clouds, c, 0);
        low = min(low, near);
        high = max(high, near);
      }
    if (low.x > high.x) return fresh ? now : before;
    before = clamp(before, low, high);
  }
  return fresh ? mix(before, now, share) : before;
}
