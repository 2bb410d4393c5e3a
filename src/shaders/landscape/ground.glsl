// What lies on the land: soil and grass, stone, snow, woods seen from afar.
#include "landscape/patches.glsl"
#if HAS_COVERS || HAS_TREE_MAP
#include "landscape/cover_map.glsl"
#endif

// As `patches`, in space.
float lumps(vec3 place, float size, float footprint, int octaves, uint seed) {
  vec3 p = place / size;
  float width = footprint / size;
  float sum = 0.0;
  float amplitude = 1.0;
  for (int i = ZERO; i < octaves; ++i) {
    float share = octave_weight(width);
    if (share <= 0.0) break;
    sum += amplitude * share * gradient_noise(p, seed + uint(i)).x;
    p = 2.03 * vec3(0.8 * p.x - 0.6 * p.z, p.y, 0.6 * p.x + 0.8 * p.z).yzx + 17.3;
    width *= 2.03;
    amplitude *= 0.6;
  }
  return sum;
}

// Stone with beds that dip a little, cracked; or plainer, from two octaves in the plane.
vec3 stone_color(vec3 p, float footprint) {
#if TEXTURE_LOW_QUALITY
  float n = patches(p.xy, ROCK_FEATURE_SIZE, footprint, 2, 11u);
  return mix(ROCK_COLOR_1, ROCK_COLOR_2, clamp(0.5 + 0.9 * n, 0.0, 1.0));
#else
  float wide = lumps(vec3(p.xy, 2.0 * p.z), ROCK_FEATURE_SIZE, footprint, 5, 11u);
  float level = p.z + 0.09 * p.x - 0.05 * p.y + 9.0 * wide;
  float series = lumps(vec3(0.004 * p.xy, level), 70.0, footprint, 2, 14u);
  float beds = lumps(vec3(0.03 * p.xy, level), 9.0, footprint, 3, 12u);
  float grain = lumps(p, 1.4, footprint, 3, 13u);
  float tone = 0.5 + 0.5 * wide + 0.6 * series + 0.35 * beds + 0.25 * grain;
  vec3 stone = mix(ROCK_COLOR_1, ROCK_COLOR_2, clamp(tone, 0.0, 1.0));
  vec3 rust = mix(vec3(1.0), vec3(1.1, 1.0, 0.88), clamp(0.4 + wide + series, 0.0, 1.0));
  return stone * (1.0 + 0.3 * beds) * rust;
#endif
}

vec3 soil_color(vec2 place, float footprint, float edge) {
  float mottle = patches(place, PATCH_SIZE, footprint, 4, 21u);
  float tone = patches(place, 8.0 * PATCH_SIZE, footprint, 4, 22u);
  float grassy = smoothstep(-0.15, 0.15, mottle + GRASS_COVER - 0.5);
  vec3 soil = mix(SOIL_COLOR_1, SOIL_COLOR_2, clamp(0.5 + mottle, 0.0, 1.0));
  vec3 grass = mix(GRASS_COLOR_1, GRASS_COLOR_2, clamp(0.5 + 0.9 * tone + 0.4 * edge, 0.0, 1.0));
  return mix(soil, grass, grassy) * (1.0 + 0.2 * edge);
}

#if HAS_TREE_MAP
float woods_on_map(vec2 place, float footprint) {
  return TREES * map_texel(tree_map, place, footprint).r;
}
#endif

// Share of the land under trees.
float woods(vec2 place, float slope, float height, float footprint) {
#if HAS_TREE_MAP
  return woods_on_map(place, footprint);
#else
  float n = patches(place, 520.0, footprint, 4, 31u);
  float gentle = 1.0 - smoothstep(30.0, 38.0, slope);
  float low = 1.0 - smoothstep(TREE_LINE - 120.0, TREE_LINE, height + 150.0 * n);
  return gentle * low * smoothstep(-0.06, 0.06, n + 1.7 * (TREES - 0.5)) * min(20.0 * TREES, 1.0);
#endif
}

#if HAS_COVERS
// Their edges are broken up by noise, and their colours vary.
vec3 with_covers(vec3 color, vec2 place, float footprint, float edge) {
  float broken = patches(place, 3.0 * TERRAIN_SCALE * MAP_CELL, footprint, 5, 51u);
  vec4 cover = map_texel(cover_map, place, footprint);
  float share = cover.a * (1.0 - cover.a) * 1.6 * broken + cover.a;
  float grain = patches(place, 4.0, footprint, 3, 57u);
  vec3 tone = cover.rgb * cover.rgb * (1.0 + 0.2 * broken + 0.2 * edge + 0.55 * grain);
  return mix(color, tone, clamp(share, 0.0, 1.0));
}
#endif

// Colour at a place (the footprint already a part of the pixel's), from the wide form of the land;
// `rise` is how far it stands above the land around it, m.
vec3 ground_color(vec2 place, vec3 wide, vec3 fine, float footprint, float rise) {
  float edge = patches(place, 45.0, footprint, 4, 1u);
  float broad = patches(place, 400.0, footprint, 4, 2u);
  float height = wide.x + 60.0 * edge + 90.0 * broad;
  float slope = degrees(atan(length(wide.yz)));
  float fine_slope = degrees(atan(length(fine.yz)));
  float steep = smoothstep(ROCK_SLOPE.x, ROCK_SLOPE.y,
                           max(slope + 6.0 * edge, 0.85 * fine_slope + 4.0 * edge));
  float rock = max(steep, smoothstep(ROCK_HEIGHT.x, ROCK_HEIGHT.y, height));
  // Wind fills hollows with snow and takes it from crests.
  float snow_slope = mix(slope, fine_slope, 0.35) + 8.0 * edge + 5.0 * broad +
                     clamp(0.35 * rise, -9.0, 7.0);
  float snow = smoothstep(SNOW_HEIGHT.x, SNOW_HEIGHT.y, height) *
               (1.0 - smoothstep(SNOW_SLOPE.x, SNOW_SLOPE.y, snow_slope));
  vec3 color = vec3(0.0);
  if (snow < 1.0) {
    if (rock < 1.0) color += (1.0 - rock) * soil_color(place, footprint, edge);
    if (rock > 0.0) {
      vec3 stone = stone_color(vec3(place, fine.x), footprint);
      // Below the cliffs their stone lies as scree, paler and even, in fans of its own angle.
      float scree = (1.0 - smoothstep(36.0, 43.0, slope + 6.0 * edge)) *
                    smoothstep(4.0, -6.0, rise + 8.0 * broad);
      vec3 loose = mix(ROCK_COLOR_1, ROCK_COLOR_2, 0.72 + 0.25 * edge) * vec3(1.03, 1.0, 0.95);
      color += rock * mix(stone, loose, 0.75 * scree);
    }
#if HAS_COVERS
    color = with_covers(color, place, footprint, edge);
#endif
#if HAS_WOODS
    float trees = woods(place, slope, wide.x, footprint);
    float crowns = patches(place, 9.0, footprint, 2, 32u);
    float stands = patches(place, 90.0, footprint, 3, 33u);
    color = mix(color, mix(CANOPY_COLOR_1, CANOPY_COLOR_2,
                           clamp(0.45 + 0.5 * crowns + 0.5 * stands, 0.0, 1.0)), trees);
#endif
  }
  return clamp(mix(color, SNOW_COLOR, snow), 0.0, 0.95);
}

// The colour of the ground that a pixel covers: the mean of FILTERING_SAMPLES² places spread over
// its footprint, which spans `across` and `up` on the land.
vec3 filtered_color(vec2 place, vec2 across, vec2 up, vec3 wide, vec3 fine, float rise) {
  float footprint = max(length(across), length(up));
#if TEXTURE_FILTERING
  vec3 sum = vec3(0.0);
  const int n = FILTERING_SAMPLES;
  for (int j = ZERO; j < n; ++j)
    for (int i = ZERO; i < n; ++i) {
      vec2 part = (vec2(i, j) + 0.5) / float(n) - 0.5;
      vec2 offset = part.x * across + part.y * up;
      vec3 w = vec3(wide.x + dot(offset, wide.yz), wide.yz);
      vec3 f = vec3(fine.x + dot(offset, fine.yz), fine.yz);
      sum += ground_color(place + offset, w, f, 0.7 * footprint / float(n), rise);
    }
  return sum / float(n * n);
#else
  return ground_color(place, wide, fine, 0.25 * footprint, rise);
#endif
}

// Where nothing is known of the land around.
vec3 filtered_color(vec2 place, vec2 across, vec2 up, vec3 wide, vec3 fine) {
  return filtered_color(place, across, up, wide, fine, 0.0);
}
