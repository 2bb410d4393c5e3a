// Air by tables: the sun's light through it and what is scattered more than once (as
// sky/sunlit_air.glsl reads them), and the sky about the eye (Hillaire, "A scalable and production
// ready sky and atmosphere rendering technique", EGSR 2020).
#include "sky/sunlit_air.glsl"

uniform highp sampler2D air_transmittances;
uniform highp sampler2D air_multiples;
uniform sampler2D sky_by_air;      // sums of scattering, not yet times the aerosol's phase function
uniform sampler2D sky_by_aerosol;
uniform sampler2D sky_passed;

// u in [0, 1] of a table's texel: its first and last centres lie at 0 and 1.
vec2 table_place(vec2 texel, vec2 size) {
  return (texel - 0.5) / (size - 1.0);
}

// Of the tables of light, the other way round than transmittance_place.
vec4 transmittance_entry(vec2 u) {
  float whole = horizon_distance(AIR, AIR.air_thickness);
  float rho = u.y * whole;
  float planet = AIR.planet_radius;
  float height = rho * rho / (planet + sqrt(planet * planet + rho * rho));
  float nearest = AIR.air_thickness - height;
  float reach = mix(nearest, rho + whole, u.x);
  float rise = (AIR.air_thickness - height) * (2.0 * planet + height + AIR.air_thickness);
  float cosine = (rise - reach * reach) / max(2.0 * (planet + height) * reach, 1e-3);
  cosine = reach <= 0.0 ? 1.0 : clamp(cosine, -1.0, 1.0);
  vec3 column = air_column(AIR, height, cosine, 0.0, reach, 48);
  return vec4(exp(-optical_depth(AIR, column)), 1.0);
}
vec4 multiple_entry(vec2 u) {
  float root = 2.0 * u.x - 1.0;
  return vec4(multiple_scattering(u.y * u.y * AIR.air_thickness, sign(root) * root * root), 1.0);
}

ScatteredSums tabled_air(AirRay ray, float reach, int steps) {
  return seen_in_sunlit_air(AIR, air_transmittances, air_multiples, ray, reach, steps);
}
AirLight tabled_air_light(AirRay ray, float reach, int steps) {
  return with_phases(AIR, tabled_air(ray, reach, steps), ray.to_sun, SUN_ILLUMINANCE);
}

// Elevation, finest at the horizon (x: 0 at the sun's azimuth, 1 opposite; y: 0.5 at the horizon).
float horizon_cosine(float height) {
  float h = max(height, 0.0);
  return -sqrt(h * (2.0 * AIR.planet_radius + h)) / (AIR.planet_radius + h);
}
vec2 sky_place(vec3 direction, float height, vec2 sun_way) {
  float horizon = asin(horizon_cosine(height));
  float over = asin(clamp(direction.z, -1.0, 1.0)) - horizon;
  float whole = over > 0.0 ? 1.5708 - horizon : 1.5708 + horizon;
  float v = 0.5 * sqrt(clamp(abs(over) / whole, 0.0, 1.0));
  float across = length(direction.xy);
  float along = dot(direction.xy, sun_way) / max(across, 1e-5);
  return vec2(acos(clamp(along, -1.0, 1.0)) / 3.14159265, over > 0.0 ? 0.5 + v : 0.5 - v);
}
vec2 sun_way_of(vec3 sun) {
  return length(sun.xy) > 1e-4 ? normalize(sun.xy) : vec2(0.0, 1.0);
}
// The ray of an entry; half of the rows are below the horizon.
AirRay sky_entry(vec2 texel, vec2 size, float height, vec3 sun) {
  float azimuth = 3.14159265 * (texel.x - 0.5) / (size.x - 1.0);
  float rows = 0.5 * size.y;
  float row = texel.y - rows;
  float v = (abs(row) - 0.5) / (rows - 1.0);
  float horizon = asin(horizon_cosine(height));
  float whole = row > 0.0 ? 1.5708 - horizon : 1.5708 + horizon;
  // A hair off the horizon, so that no ray grazes.
  float elevation = horizon + sign(row) * max(v * v * whole, 2e-4);
  float sun_across = length(sun.xy);
  float z = sin(elevation);
  float to_sun = z * sun.z + cos(elevation) * sun_across * cos(azimuth);
  return AirRay(height, z, sun.z, clamp(to_sun, -1.0, 1.0));
}
vec2 sky_texture_place(vec2 u, vec2 size) {
  float rows = 0.5 * size.y;
  float away = abs(u.y - 0.5) * 2.0 * (rows - 1.0) + 0.5;
  float y = u.y > 0.5 ? rows + away : rows - away;
  return vec2(u.x * (size.x - 1.0) + 0.5, y) / size;
}

AirLight sky_air(AirRay ray, vec3 direction, Light light) {
  vec2 size = vec2(textureSize(sky_by_air, 0));
  vec2 at = sky_texture_place(sky_place(direction, ray.height, sun_way_of(light.direction)), size);
  vec3 around = textureLod(sky_by_air, at, 0.0).rgb +
                textureLod(sky_by_aerosol, at, 0.0).rgb *
                    mie_phase(ray.to_sun, AIR.aerosol_forward);
  return AirLight(textureLod(sky_passed, at, 0.0).rgb, SUN_ILLUMINANCE * around);
}
