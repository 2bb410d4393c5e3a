// Clouds before what is behind them.

uniform float start_turn;  // of the place within the first step

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
  float scattered = 0.0;
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
    float passed = exp(-extinction * dense * stride);
    float weight = seen.transmittance * (1.0 - passed);
    // What adds little is lit as what was before it.
    if (weight > 0.06 || weights <= 0.0) {
      float sun_cosine = sun_cosine_after(AIR, ray, s);
      float lit = sunlit_share(layer, at, AirRay(height, sun_cosine, sun_cosine, 1.0),
                               light.direction);
      scattered = scattered_in_cloud(c, ray.to_sun, lit);
    }
    float v = (height - c.height) / c.thickness;
    vec3 around = sky_radiance * mix(0.55, 1.15, clamp(v, 0.0, 1.0));
    vec3 source = (scattered * sun_on_clouds() + around) * (c.scattering / extinction);
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

// Light of the clouds along a ray, with the air before them, and how much of what is behind they
// hide; `away` is their mean distance.
struct FastClouds {
  vec3 light;
  float hidden;
  float away;
};

float cloud_start(vec2 pixel) {
  return fract(random_of(floor(pixel)) + start_turn);
}

FastClouds fast_clouds_before(vec2 place, AirRay air, vec3 direction, float reach, Light light,
                              float start, float time) {
  FastClouds none = FastClouds(vec3(0.0), 0.0, sky_distance);
#if CLOUD_STEPS > 0
  if (CLOUD_COVERAGE <= 0.0) return none;
  AirSpan span = span_in_layer(AIR, air.height, air.cosine, CLOUDS_HEIGHT,
                               CLOUDS_HEIGHT + CLOUDS_THICKNESS);
  if (!(min(span.end, reach) > span.begin) || span.begin > MAX_CLOUD_DISTANCE) return none;
  vec3 on_ground = light.sky + max(light.direction.z, 0.0) * light.sun;
  vec3 around = (light.sky + AIR.ground_albedo * on_ground) / 6.2832;
  float away;
  CloudLight clouds = fast_clouds_met(
      landscape_clouds(), wind_place(place, time), air, direction, light,
      min(reach, span.begin + 12.0 * CLOUDS_THICKNESS), around, start, away);
  float near = 1.0 - smoothstep(0.6, 1.0, span.begin / MAX_CLOUD_DISTANCE);
  float hidden = near * (1.0 - clouds.transmittance);
  if (hidden < 0.001) return FastClouds(vec3(0.0), 0.0, away);
  AirLight before = tabled_air_light(air, span.begin, 5);
  return FastClouds(near * clouds.light * before.transmittance + before.light * hidden, hidden,
                    away);
#else
  return none;
#endif
}

// Clouds over a new pixel of the land's picture; distance, below 0 of what the wind moves.
vec4 behind_fast_clouds(vec4 land, vec2 pixel, vec2 resolution, float time) {
  View view = seen_from(frame_view);
  vec3 direction = view_ray(view, pixel, resolution);
  Light light = frame_light();
  AirRay air = AirRay(view.height, direction.z, light.direction.z, dot(direction, light.direction));
  bool met = land.a > 0.0;
  FastClouds clouds = fast_clouds_before(view.place, air, direction, met ? land.a : 1e9, light,
                                         cloud_start(pixel), time);
  vec3 seen = land.rgb * (1.0 - clouds.hidden) + min(frame_exposure() * clouds.light, 6e4);
  return vec4(seen, met && clouds.hidden <= 0.5 ? land.a : -clouds.away);
}
