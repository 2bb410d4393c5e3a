// Water over the land of a map. Near by it lies where its level is above the ground; from so far
// that a sample of the map is less than what is looked at, it covers a share of the place.

// R: of level 0 the height of the water's surface, below the ground where there is none; of the
// others the mean height of what is seen, ground or water. G: the share under water.
uniform highp sampler2D water_map;

// Bilinear: height, its derivative by texels, share. `at` in texels of level 0.
vec4 water_level(vec2 at, int level) {
  ivec2 last = textureSize(water_map, level) - 1;
  vec2 p = (at + 0.5) / exp2(float(level)) - 0.5;
  vec2 below = floor(p);
  vec2 f = p - below;
  ivec2 low = clamp(ivec2(below), ivec2(0), last);
  ivec2 high = clamp(ivec2(below) + 1, ivec2(0), last);
  vec2 a = texelFetch(water_map, low, level).rg;
  vec2 b = texelFetch(water_map, ivec2(high.x, low.y), level).rg;
  vec2 c = texelFetch(water_map, ivec2(low.x, high.y), level).rg;
  vec2 d = texelFetch(water_map, high, level).rg;
  vec2 mean = mix(mix(a, b, f.x), mix(c, d, f.x), f.y);
  vec2 slope = vec2(mix(b.x - a.x, d.x - c.x, f.y), mix(c.x - a.x, d.x - b.x, f.x));
  return vec4(mean.x, slope * exp2(-float(level)), mean.y);
}

// What is seen where the ground is so high (`bare`: without what is smaller than the map's cells).
vec3 under_water(vec3 ground, float bare, MapPlace on, float level, out vec2 water) {
  float far = smoothstep(0.0, 1.0, level);
  vec3 seen = vec3(0.0);
  water = vec2(0.0);
  if (far < 1.0) {
    vec4 surface = water_level(on.at, 0);
    bool wet = surface.x > ground.x;
    surface.yz *= on.sense / MAP_CELL;
    seen += (1.0 - far) * (wet ? surface.xyz : ground);
    if (wet) water += (1.0 - far) * vec2(1.0, surface.x - ground.x);
  }
  if (far > 0.0) {
    // Level 0 is another one, also where there is no other but one.
    float most = coarsest_level();
    float fine = clamp(floor(level), 1.0, max(most - 1.0, 1.0));
    vec4 surface = mix(water_level(on.at, int(fine)), water_level(on.at, int(min(fine + 1.0, most))),
                       clamp(level - fine, 0.0, 1.0));
    surface.yz *= on.sense / MAP_CELL;
    seen += far * surface.xyz;
    float share = smoothstep(0.02, 0.98, surface.w);
    water += far * vec2(share, max(surface.x - bare, 0.0) / max(surface.w, 0.05));
  }
  return seen;
}
