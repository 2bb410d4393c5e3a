// The light on leaves and wood within a crown.
#include "raster/light.glsl"

uniform vec2 crown_light_range;  // m; from here on the crown's own shade is not that of shadow maps
uniform vec3 radiance_below;     // cd/m², of the sky's lower half
uniform sampler2D land_colors;   // reflectance
uniform vec4 land_place;         // texture = zw + xy · place
uniform float crown_reach;       // m, from the plant's middle to its outside

// Share of light from a direction that the crown lets through.
float let_through(vec4 crown_light, vec3 direction) {
  return clamp(crown_light.w + dot(crown_light.xyz, direction), 0.0, 1.0);
}
// Of the hemisphere about n, by cosine.
float let_through_about(vec4 crown_light, vec3 n) {
  return clamp(crown_light.w + 0.6667 * dot(crown_light.xyz, n), 0.02, 1.0);
}

// Near by, shadow maps have the leaves; farther off they are too coarse, and hold what stands
// around. `extinction`: among the plant's leaves, 1/m.
float crown_sun_share(vec3 place, vec3 normal, vec4 crown_light, float extinction,
                      float far_share) {
  float near = far_share < 1.0 ? sun_share(place, normal, extinction) : 0.0;
  if (far_share <= 0.0) return near;
  float far = let_through(crown_light, sun_direction);
  far *= sun_share(place + crown_reach * sun_direction, sun_direction);
  return mix(near, far, far_share);
}

// Part of the sky past land and crowns around.
float past_others(vec3 place) {
  return exp(-0.5 * canopy_above(place).y) * terrain_sky_share(place);
}

// Radiance of the land about a place, in the light that comes down to it past crowns, cd/m².
vec3 land_radiance(vec3 place) {
  vec3 reflectance = texture(land_colors, land_place.zw + land_place.xy * place.xy).rgb;
  float leaves = canopy_around(place);
  float sky = exp(-0.6 * leaves) * terrain_sky_share(place);
  float rise = max(sun_direction.z, 0.0);
  float sun = exp(-0.5 * leaves / max(rise, 0.1)) * terrain_sun_share(place);
  vec3 light = sky * open_irradiance(vec3(0.0, 0.0, 1.0)) + (sun * rise) * sun_irradiance;
  return reflectance * light / light_pi;
}

vec3 crown_ambient(vec3 place, vec3 normal, vec4 crown_light, vec3 albedo) {
  // Its own crown hides what it does; others hide what they do from their middle on.
  float own = let_through_about(crown_light, normal);
  float seen = own * past_others(place);
  // What looks down sees the land that is there, not that of the open.
  float below = 0.5 * light_pi * (1.0 - normal.z);
  vec3 sky = max(open_irradiance(normal) - below * radiance_below, vec3(0.0));
  vec3 light = sky * seen + land_radiance(place) * (below * own);
  // What leaves around hide, they also scatter on: J. Jimenez et al., "Practical real-time
  // strategies for accurate indirect occlusion", 2016.
  return light / (1.0 - albedo * (1.0 - seen));
}

// Mean of the cosine to the sun over leaves that look everywhere, as seen from the eye: of those lit
// on the side that is seen, and of those lit from behind (Ross, 1981).
vec2 spread_cosines(float cosine) {
  float angle = acos(clamp(cosine, -1.0, 1.0));
  float s = sin(angle);
  return vec2((light_pi - angle) * cosine + s, s - angle * cosine) * (2.0 / (3.0 * light_pi));
}

float coat_fresnel(float cosine) {
  return 0.04 + 0.96 * pow(1.0 - clamp(cosine, 0.0, 1.0), 5.0);
}
// Its mean by cosine over a hemisphere.
const float coat_mean = 0.0857;

// Of an even sky, what a rough coat mirrors: less than a smooth one at grazing angles, where the
// slopes that are seen look towards the eye. A fit by B. Karis, "Physically based shading on
// mobile", 2014.
float coat_mirrored(float cosine, float roughness) {
  vec4 r = roughness * vec4(-1.0, -0.0275, -0.572, 0.022) + vec4(1.0, 0.0425, 1.04, -0.04);
  float a = min(r.x * r.x, exp2(-9.28 * cosine)) * r.x + r.y;
  return max(0.04 * (r.z - 1.04 * a) + 1.04 * a + r.w, 0.0);
}

// What the waxy coat of leaves mirrors (render/bsdf.hpp; the sky's part by its irradiance about the
// mirrored direction). Of leaves that look everywhere, the mean: of the sky about as at 60 degrees,
// and of the sun F / (4 π) from those that lie right for it.
vec3 crown_coat(vec3 normal, float spread, vec3 to_eye, float roughness, vec3 sky_seen,
                vec3 sun_seen) {
  float facing = max(dot(normal, to_eye), 0.05);
  vec3 light = sky_seen * (coat_mirrored(mix(facing, 0.5, spread), roughness) / light_pi);
  vec3 half_way = normalize(to_eye + sun_direction);
  float a2 = pow(roughness, 4.0);
  float cosine = max(dot(normal, half_way), 0.0);
  float d = cosine * cosine * (a2 - 1.0) + 1.0;
  float across = max(dot(to_eye, half_way), 0.1);
  // Visibility after C. Kelemen, L. Szirmay-Kalos, Eurographics 2001.
  float lobe = a2 / (light_pi * d * d) / (4.0 * across * across) *
               max(dot(normal, sun_direction), 0.0);
  return light + sun_seen * coat_fresnel(across) * mix(lobe, 0.18 / light_pi, spread);
}

// `mean_normal` is the mean of the normals of what is seen, on the side of the eye: of unit length
// where all has the same. `spread`: 0 there, 1 where leaves look everywhere.
vec3 crown_radiance(vec3 place, vec3 mean_normal, float spread, vec3 reflectance,
                    vec3 transmittance, float roughness, vec4 crown_light, float extinction,
                    float far_share) {
  vec3 normal = mean_normal / max(length(mean_normal), 1e-3);
  float facing = dot(normal, sun_direction);
  vec2 cosines = vec2(max(facing, 0.0), max(-facing, 0.0));
  if (spread > 0.0)
    cosines = mix(cosines, spread_cosines(dot(normalize(eye - place), sun_direction)), spread);
  vec3 scattered = reflectance * cosines.x + transmittance * cosines.y;
  vec3 albedo = reflectance + transmittance;
  vec3 light = reflectance * crown_ambient(place, mean_normal, crown_light, albedo);
  if (transmittance.g > 0.0)
    light += transmittance * crown_ambient(place, -mean_normal, crown_light, albedo);
  vec3 sun = vec3(0.0);
  if (scattered.g > 0.0)
    sun = sun_irradiance * crown_sun_share(place, normal, crown_light, extinction, far_share);
  vec3 to_eye = normalize(eye - place);
  if (roughness > 0.0) {
    // What the coat lets in, and out again.
    light *= 1.0 - coat_mean;
    scattered *= 1.0 - mix(coat_fresnel(abs(facing)), coat_mean, spread);
  }
  light = (light + scattered * sun) / light_pi;
  if (roughness <= 0.0) return light;
  light *= 1.0 - mix(coat_fresnel(dot(normal, to_eye)), coat_mean, spread);
  // Far away one leaf is drawn for many, and must not glitter for all of them; they mirror all that
  // is around.
  float many = max(spread, far_share);
  // Where a rough coat mirrors most: between the normal and the mirrored direction. S. Lagarde,
  // C. de Rousiers, "Moving Frostbite to physically based rendering", SIGGRAPH 2014, 4.9.3.
  float alpha = roughness * roughness;
  float towards = (1.0 - alpha) * (sqrt(1.0 - alpha) + alpha);
  vec3 mirrored = normalize(mix(normal, reflect(-to_eye, normal), towards)) * (1.0 - many);
  vec3 sky_seen = crown_ambient(place, mirrored, crown_light, vec3(0.0));
  return light + crown_coat(normal, many, to_eye, roughness, sky_seen, sun);
}
