// Sun, sky and air of the moment.
#include "image/tonemap.glsl"
#include "sky/air_march.glsl"
#include "sky/clouds.glsl"

vec3 sun_direction(float time) {
  float elevation = radians(SUN_ELEVATION);
  float azimuth = radians(SUN_AZIMUTH);
  vec3 sun = vec3(cos(elevation) * sin(azimuth), cos(elevation) * cos(azimuth), sin(elevation));
  // The day goes round an axis that points north and up as at 45 degrees of latitude.
  float turn = radians(DAY_SPEED) * time;
  vec3 axis = vec3(0.0, 0.7071068, 0.7071068);
  return cos(turn) * sun - sin(turn) * cross(axis, sun) +
         (1.0 - cos(turn)) * dot(axis, sun) * axis;
}

// What scatters light in the air: the sun through the air above, and light from all around.
LightInAir light_in_air(Atmosphere a, float height, float sun_cosine) {
  return LightInAir(sun_transmittance(a, height, sun_cosine, ATMOS_LIGHT_STEPS),
                    multiple_scattering(height, sun_cosine));
}

AirLight air_between(AirRay ray, float reach, int steps) {
  return with_phases(AIR, march(AIR, ray, reach, steps), ray.to_sun, SUN_ILLUMINANCE);
}

struct Light {
  vec3 direction;
  vec3 sun;  // on a surface that faces it, klx
  vec3 sky;  // on level ground, klx
};

vec3 night_sky() {
  return NIGHT_BRIGHTNESS * vec3(0.55, 0.85, 3.8);
}

Light light_at(vec3 sun, float height) {
  vec3 direct = SUN_ILLUMINANCE * sun_transmittance(AIR, max(height, 0.0), sun.z, 8);
  vec3 sky = SUN_ILLUMINANCE * sky_on_ground(sun.z) + 3.1416 * night_sky();
#if CLOUD_STEPS > 0
  // Clouds hide a part of the blue and send down white light.
  vec3 white = 0.45 * (max(sun.z, 0.0) * direct + sky);
  sky = mix(sky, white, 0.8 * CLOUD_COVERAGE);
#endif
  return Light(sun, direct, sky);
}

CloudLayer landscape_clouds() {
  float density = CLOUD_DENSITY;
  return cloud_layer(Clouds(clamp(CLOUD_COVERAGE, 1e-3, 0.999), CLOUDS_HEIGHT, CLOUDS_THICKNESS,
                            CLOUD_SIZE, CLOUD_BILLOWS, density * CLOUD_SCATTERING,
                            density * CLOUD_ABSORPTION, CLOUD_FORWARD, CLOUD_BACK,
                            CLOUD_BACK_SHARE, CLOUD_ORDERS, CLOUD_SEED));
}

vec2 wind_place(vec2 place, float time) {
  return place - vec2(WIND_SPEED * time, 0.0);
}

// Share of the sun that clouds let through to a place.
float cloud_shadow(vec2 place, float height, vec3 sun, float time) {
#if CLOUD_STEPS > 0
  if (sun.z <= 0.02 || CLOUD_COVERAGE <= 0.0 || CLOUD_SHADOWS <= 0.0) return 1.0;
  AirRay ray = AirRay(height, sun.z, sun.z, 1.0);
  float passed =
      cloud_transmittance(landscape_clouds(), AIR, wind_place(place, time), ray, sun, 60000.0, 5);
  return mix(1.0, passed, CLOUD_SHADOWS);
#else
  return 1.0;
#endif
}

// The sun's disc, and a plain where the planet is met beyond the land.
vec3 behind_air(AirRay ray, Light light) {
  AirSpan span = span_in_air(AIR, ray.height, ray.cosine);
  if (span.ground) {
    float sine = sun_cosine_after(AIR, ray, span.end);
    vec3 sun = SUN_ILLUMINANCE * sun_transmittance(AIR, 0.0, sine, 8) * max(sine, 0.0);
    return AIR.ground_albedo / 3.1416 * (sun + light.sky);
  }
  float off = acos(clamp(ray.to_sun, -1.0, 1.0)) / 0.004625;
  float disc = 1.0 - smoothstep(0.95, 1.05, off);
  float limb = sqrt(max(0.0, 1.0 - off * off));
  return night_sky() + SUN_ILLUMINANCE / 6.72e-5 * disc * (0.4 + 0.6 * limb);
}

// Of the tone map, per kcd/m²: as an eye or a camera would set it, less than wholly.
float exposure_for(Light light) {
  vec3 on_ground = light.sun * (0.3 + 0.7 * max(light.direction.z, 0.0)) + light.sky;
  float level = max(dot(on_ground, vec3(0.2126, 0.7152, 0.0722)), 0.002);
  return exp2(EXPOSURE) * 3.4 * pow(level, -0.87);
}
