// Twin of Ground::surface (render/ground.hpp): colours and normal of the ground at a place, for a
// footprint in metres. Parts that have no share are not worked out, octaves finer than the
// footprint neither.
#include "render/ground_heights.glsl"
#include "render/two_colors.glsl"

// Soil, grass, rock, canopy: colours, and feature size, contrast, stretch.
uniform vec3 ground_colors1[4];
uniform vec3 ground_colors2[4];
uniform vec3 ground_textures[4];
uniform vec3 snow_color;
uniform vec4 height_bands;  // of rock, of snow: low, high, m
uniform vec3 cover_colors1[most_covers];
uniform vec3 cover_colors2[most_covers];
uniform vec4 water_body;  // colour, clarity
uniform vec2 water_coat;  // roughness, ripples

const float edge_size = 45.0;
const float grain_size = 1.7;
const float ripple_size = 1.2;
const float least_footprint = 0.004;
const int texture_octaves = 5;

struct GroundSurface {
  vec3 normal;
  vec3 reflectance;
  float roughness;  // of a clear coat; 0 for none
  float height;     // m
};

// What covers the ground at a place.
struct GroundShares {
  float jitter;
  float grain;
  float rock;
  float snow;
  float canopy;
};

vec3 ground_texture(int which, vec3 p, float footprint) {
  vec3 look = ground_textures[which];
  float n = ground_fbm(textures_row + texture_octaves * which, texture_octaves,
                       vec3(p.xy, p.z / look.z) / look.x, footprint / look.x);
  return mix_two_colors(ground_colors1[which], ground_colors2[which], look.y, n);
}

vec3 cover_texture(int k, vec3 p, float footprint) {
  vec4 look = cover_looks[k];
  float n = ground_fbm(textures_row + texture_octaves * (4 + k), texture_octaves, p / look.x,
                       footprint / look.x);
  return mix_two_colors(cover_colors1[k], cover_colors2[k], look.y, n);
}

GroundShares ground_cover(vec2 place, float footprint, vec3 base, vec3 detailed, float canopy) {
  GroundShares c;
  c.canopy = canopy;
  c.jitter = ground_fbm(edges_row, 5, place / edge_size, footprint / edge_size);
  c.grain = ground_fbm(grains_row, 4, place / grain_size, footprint / grain_size);
  float base_slope = slope_degrees(base.yz) + 6.0 * c.jitter;
  float small_slope = slope_degrees(detailed.yz) + 4.0 * c.grain;
  float height = base.x + 60.0 * c.jitter;
  float steep = ground_step(ground_slopes.x, ground_slopes.y, max(base_slope, 0.75 * small_slope));
  c.rock = max(steep, ground_step(height_bands.x, height_bands.y, height));
  c.snow = ground_step(height_bands.z, height_bands.w, height);
  if (c.snow > 0.0)
    c.snow *= 1.0 - ground_step(ground_slopes.z, ground_slopes.w, 0.5 * (base_slope + small_slope));
  return c;
}

vec3 soil_and_grass(vec3 p, float footprint, GroundShares c) {
  float patch_size = ground_shares.y;
  float spot = ground_fbm(patches_row, 5, p.xy / patch_size, footprint / patch_size);
  float threshold = 0.5 - ground_shares.x;
  float grassy = ground_step(threshold - 0.12, threshold + 0.12, spot + 0.35 * c.grain);
  vec3 color = vec3(0.0);
  if (grassy < 1.0) color += (1.0 - grassy) * ground_texture(0, p, footprint);
  if (grassy > 0.0) color += grassy * ground_texture(1, p, footprint);
  return color * (1.0 + 0.25 * c.jitter);
}

vec3 bare_ground(vec3 p, float footprint, GroundShares c) {
  vec3 color = vec3(0.0);
  if (c.canopy < 1.0) {
    if (c.rock < 1.0) color += (1.0 - c.rock) * soil_and_grass(p, footprint, c);
    if (c.rock > 0.0) color += c.rock * (1.0 + 0.3 * c.grain) * ground_texture(2, p, footprint);
  }
  if (c.canopy > 0.0) color = mix(color, ground_texture(3, p, footprint), c.canopy);
  return color;
}

// Covers that lie over snow, or those that do not.
void lay_covers(bool over_snow, vec3 p, float footprint, float noise, inout vec3 color,
                inout float roughness) {
  for (int k = 0; k < cover_count; ++k) {
    if ((cover_kinds[k].y > 0.0) != over_snow) continue;
    float share = cover_share(k, p.xy, noise);
    if (share <= 0.0) continue;
    color = mix(color, cover_texture(k, p, footprint), share);
    if (share > 0.5) roughness = cover_looks[k].z;
  }
}

GroundSurface land_surface(vec2 place, float footprint, vec3 base, vec3 detailed, float canopy) {
  vec3 p = vec3(place, detailed.x);
  GroundShares c = ground_cover(place, footprint, base, detailed, canopy);
  GroundSurface s;
  s.normal = normalize(vec3(-detailed.yz, 1.0));
  s.roughness = 0.0;
  s.height = detailed.x;
  vec3 color = c.snow < 1.0 ? bare_ground(p, footprint, c) : vec3(0.0);
  float noise = c.jitter + 0.5 * c.grain;
  lay_covers(false, p, footprint, noise, color, s.roughness);
  color = mix(color, snow_color, c.snow);
  if (c.snow > 0.5) s.roughness = 0.0;
  lay_covers(true, p, footprint, noise, color, s.roughness);
  s.reflectance = clamp(color, 0.0, 0.95);
  return s;
}

GroundSurface ground_surface(vec2 place, float lift, float footprint) {
  float width = max(footprint, least_footprint);
  vec3 base = ground_base(place, lift);
  float canopy = canopy_share(place, slope_degrees(base.yz));
  vec3 detailed = with_detail(base, place, canopy, width);
  float level = water_level(place, lift);
  if (level <= detailed.x) return land_surface(place, width, base, detailed, canopy);
  // Light goes down to the bed and up again.
  float shown = exp((detailed.x - level) / water_body.w);
  GroundSurface s;
  s.reflectance = vec3(0.0);
  if (shown > 0.002) s = land_surface(place, width, base, detailed, canopy);
  s.reflectance = mix(water_body.rgb, s.reflectance, shown);
  s.roughness = water_coat.x;
  vec3 n = ground_fractal(ripples_row, 4, false, place / ripple_size, width / ripple_size);
  s.normal = normalize(vec3(-water_coat.y * n.yz, 1.0));
  s.height = level;
  return s;
}
