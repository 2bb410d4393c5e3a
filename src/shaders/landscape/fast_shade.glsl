// Shade of clouds on the land: transmittance of sun rays by where they enter the layer, baked
// about the eye and carried along by the wind.

uniform highp sampler2DArray cloud_shades;
uniform float shade_cell;  // m, of the first level
uniform int shade_levels;
uniform vec2 shade_middle;  // the squares lie about it

// Beside the shade: the most that a cloud's shape reaches over a place, of some heights.
float baked_cloud_cover(vec2 place) {
  CloudLayer layer = landscape_clouds();
  Fractal noise = Fractal(fractal_fbm, noise_basis_value, 6, 2.0, 1.0, 1.0, 2.0, 0.0, 1.0);
  float most = -1.0;
  for (int k = ZERO; k < 12; ++k) {
    float v = (float(k) + 0.5) / 12.0;
    LatticePlace3 p = lattice_place(vec3(place, CLOUDS_HEIGHT + v * CLOUDS_THICKNESS), CLOUD_SIZE);
    float n = 0.5 + 0.5 * fbm_value(p, noise, CLOUD_SEED, 6, 0.0);
    most = max(most, n - layer.threshold - 0.3 * v * v);
  }
  return most;
}

vec3 shade_place(vec2 place) {
  vec2 offset = abs(place - shade_middle);
  float size = float(textureSize(cloud_shades, 0).x);
  float level = ceil(log2(max(max(offset.x, offset.y) / ((0.5 * size - 12.0) * shade_cell), 1e-6)));
  level = clamp(level, 0.0, float(shade_levels - 1));
  vec2 at = place / (shade_cell * exp2(level));
  return vec3((at + 0.5) / size, level);
}

// Beyond the squares: there may be one.
bool maybe_cloud(vec2 place) {
  vec2 offset = abs(place - shade_middle);
  float texels = 0.5 * float(textureSize(cloud_shades, 0).x) - 12.0;
  float reach = texels * shade_cell * exp2(float(shade_levels - 1));
  if (max(offset.x, offset.y) > reach) return true;
  return textureLod(cloud_shades, shade_place(place), 0.0).g > -0.05;
}

// Cloud along a stretch of a ray in the layer, ∫ density ds, m; nothing is worked out where none
// stands.
float cloud_along(CloudLayer layer, vec2 place, AirRay ray, vec3 direction, float reach,
                  int steps) {
  float sum = 0.0;
  float from = 0.0;
  for (int k = 1; k <= steps; ++k) {
    float to = reach * step_edge(k, steps);
    float s = 0.5 * (from + to);
    vec2 at = place + s * direction.xy;
    if (maybe_cloud(at))
      sum += (to - from) * cloud_density(layer, at, height_after(AIR, ray.height, ray.cosine, s));
    from = to;
  }
  return sum;
}

float entry_distance(float height, float sun_cosine) {
  Crossing base = crossing(AIR, height, sun_cosine, CLOUDS_HEIGHT);
  return height < CLOUDS_HEIGHT && base.meets ? max(base.far_distance, 0.0) : 0.0;
}

float baked_cloud_shade(vec2 entry, vec3 sun) {
  AirRay ray = AirRay(CLOUDS_HEIGHT, sun.z, sun.z, 1.0);
  return cloud_transmittance(landscape_clouds(), AIR, entry, ray, sun, 60000.0, 5);
}

float shade_of_clouds(vec2 place, float height, vec3 sun, float time) {
#if CLOUD_STEPS > 0
  if (sun.z <= 0.02 || CLOUD_COVERAGE <= 0.0 || CLOUD_SHADOWS <= 0.0) return 1.0;
  vec2 entry = wind_place(place, time) + entry_distance(height, sun.z) * sun.xy;
  float passed = textureLod(cloud_shades, shade_place(entry), 0.0).r;
  return mix(1.0, passed, CLOUD_SHADOWS);
#else
  return 1.0;
#endif
}
