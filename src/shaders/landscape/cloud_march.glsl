// Clouds along a ray in few steps: long ones through clear air, and short ones from where a cloud
// begins, so that its surface shows neither grain nor layers. CLOUD_EVEN_STEPS: all alike.
#include "sky/clouds.glsl"

#ifndef ZERO
#define ZERO 0
#endif
#ifndef CLOUD_EVEN_STEPS
#define CLOUD_EVEN_STEPS 0
#endif

CloudLight clouds_met(CloudLayer layer, Atmosphere a, vec2 place, AirRay ray, vec3 direction,
                      vec3 sun_direction, float reach, vec3 sun_illuminance, vec3 sky_radiance,
                      float start, CloudSteps steps) {
  Clouds c = layer.clouds;
  CloudLight seen = CloudLight(1.0, vec3(0.0));
  AirSpan span = span_in_layer(a, ray.height, ray.cosine, c.height, c.height + c.thickness);
  float end = min(reach, span.end);
  float extinction = c.scattering + c.absorption;
  if (!(end > span.begin) || !(extinction > 0.0)) return seen;
  float longest = (end - span.begin) / float(steps.along);
  // Of a free path in the densest cloud; far off, of what a pixel shows.
  float shortest = min(longest, max(0.6 / extinction, 5e-4 * span.begin));
#if CLOUD_EVEN_STEPS == 1
  shortest = longest;
#endif
  float stride = longest;
  float s = span.begin + start * longest;
  for (int k = ZERO; k < 3 * steps.along && s < end && seen.transmittance > 0.01; ++k) {
    float height = height_after(a, ray.height, ray.cosine, s);
    vec2 at = place + s * direction.xy;
    float dense = cloud_density(layer, at, height);
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
    float sun_cosine = sun_cosine_after(a, ray, s);
    AirRay sunward = AirRay(height, sun_cosine, sun_cosine, 1.0);
    float lit = cloud_transmittance(layer, a, at, sunward, sun_direction, 1e30, steps.to_sun);
    float passed = exp(-extinction * dense * stride);
    // Deep between billows less of the sky is seen.
    float v = (height - c.height) / c.thickness;
    vec3 around = sky_radiance * mix(0.55, 1.15, clamp(v, 0.0, 1.0));
    vec3 source = (scattered_in_cloud(c, ray.to_sun, lit) * sun_illuminance + around) *
                  (c.scattering / extinction);
    seen.light += seen.transmittance * (1.0 - passed) * source;
    seen.transmittance *= passed;
    s += stride;
    stride = min(1.25 * stride, longest);
  }
  seen.light /= max(1.0 - seen.transmittance, 1e-3);
  seen.transmittance = max(0.0, (seen.transmittance - 0.01) / 0.99);
  seen.light *= 1.0 - seen.transmittance;
  return seen;
}
