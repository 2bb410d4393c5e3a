// What lies on the land: soil and grass, stone, snow, woods seen from afar.
#include "landscape/patches.glsl"

struct Surface {
  vec3 normal;
  vec3 albedo;
};

// The same in space.
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
  float beds = lumps(vec3(0.06 * p.xy, p.z + 0.2 * p.x + 6.0 * wide), 9.0, footprint, 3, 12u);
  float grain = lumps(p, 1.4, footprint, 3, 13u);
  float tone = 0.5 + 0.75 * wide + 0.35 * beds + 0.25 * grain;
  vec3 stone = mix(ROCK_COLOR_1, ROCK_COLOR_2, clamp(tone, 0.0, 1.0));
  return stone * (1.0 + 0.25 * beds) * mix(vec3(1.0), vec3(1.06, 1.0, 0.93), clamp(wide, 0.0, 1.0));
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

// Share of the land under trees.
float woods(vec2 place, float slope, float height, float footprint) {
  float n = patches(place, 520.0, footprint, 4, 31u);
  float gentle = 1.0 - smoothstep(30.0, 38.0, slope);
  float low = 1.0 - smoothstep(TREE_LINE - 120.0, TREE_LINE, height + 150.0 * n);
  return gentle * low * smoothstep(-0.06, 0.06, n + TREES - 0.5);
}

// Colour at a place (the footprint already a part of the pixel's), from the wide form of the land.
vec3 ground_color(vec2 place, vec3 wide, vec3 fine, float footprint) {
  float edge = patches(place, 45.0, footprint, 4, 1u);
  float broad = patches(place, 400.0, footprint, 4, 2u);
  float height = wide.x + 60.0 * edge + 90.0 * broad;
  float slope = degrees(atan(length(wide.yz)));
  float fine_slope = degrees(atan(length(fine.yz)));
  float steep = smoothstep(ROCK_SLOPE.x, ROCK_SLOPE.y,
                           max(slope + 6.0 * edge, 0.85 * fine_slope + 4.0 * edge));
  float rock = max(steep, smoothstep(ROCK_HEIGHT.x, ROCK_HEIGHT.y, height));
  float snow_slope = 0.5 * (slope + fine_slope) + 8.0 * edge + 5.0 * broad;
  float snow = smoothstep(SNOW_HEIGHT.x, SNOW_HEIGHT.y, height) *
               (1.0 - smoothstep(SNOW_SLOPE.x, SNOW_SLOPE.y, snow_slope));
  vec3 color = vec3(0.0);
  if (snow < 1.0) {
    if (rock < 1.0) color += (1.0 - rock) * soil_color(place, footprint, edge);
    if (rock > 0.0) color += rock * stone_color(vec3(place, fine.x), footprint);
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
vec3 filtered_color(vec2 place, vec2 across, vec2 up, vec3 wide, vec3 fine) {
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
      sum += ground_color(place + offset, w, f, 0.7 * footprint / float(n));
    }
  return sum / float(n * n);
#else
  return ground_color(place, wide, fine, 0.25 * footprint);
#endif
}
