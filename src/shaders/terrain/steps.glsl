// What terrain steps do with heights and their derivatives (vec3): the twins of terrain/.
#include "terrain/fractal_ground.glsl"

vec3 soft_threshold(float edge, float width, vec3 x) {
  if (width <= 0.0) return vec3(x.x >= edge ? 1.0 : 0.0, 0.0, 0.0);
  float t = clamp((x.x - edge) / width + 0.5, 0.0, 1.0);
  return vec3(t * t * (3.0 - 2.0 * t), 6.0 * t * (1.0 - t) / width * x.yz);
}

vec3 higher(vec3 a, vec3 b) {
  return a.x >= b.x ? a : b;
}
vec3 lower(vec3 a, vec3 b) {
  return a.x <= b.x ? a : b;
}

// The larger of two, rounded off where they differ by less than `softness`.
vec3 soft_higher(vec3 a, vec3 b, float softness) {
  if (softness <= 0.0) return higher(a, b);
  vec3 d = a.x >= b.x ? a - b : b - a;
  float overlap = max(0.0, softness - d.x);
  return higher(a, b) + vec3(overlap * overlap / (4.0 * softness),
                             -overlap / (2.0 * softness) * d.yz);
}
vec3 soft_lower(vec3 a, vec3 b, float softness) {
  return -soft_higher(-a, -b, softness);
}

vec3 level_ground(float height) {
  return vec3(height, 0.0, 0.0);
}

// mix(before, made, mask), all with derivatives.
vec3 masked(vec3 before, vec3 made, vec3 mask) {
  return before + product(mask, made - before);
}

// Degrees.
float ground_slope(vec3 ground) {
  return degrees(atan(length(ground.yz)));
}

// Noise stretched to reach its bounds, and held to them.
vec3 bend(vec3 noise) {
  vec3 n = 1.6 * noise;
  return abs(n.x) > 1.0 ? vec3(sign(n.x), 0.0, 0.0) : n;
}

// The ground at a place moved by `distance` times (east, north), of which `east` and `north` hold
// value and derivative.
vec3 moved_ground(vec3 there, vec3 east, vec3 north, float distance) {
  return vec3(there.x,
              there.yz + distance * (there.y * east.yz + there.z * north.yz));
}

vec3 terraced(vec3 h, vec3 shift, float spacing, float flatness, float strength) {
  vec3 x = (h + shift) / spacing;
  float layer = floor(x.x);
  float t = clamp((x.x - layer - flatness) / (1.0 - flatness), 0.0, 1.0);
  vec3 stepped = spacing * vec3(layer + t * t * (3.0 - 2.0 * t),
                                6.0 * t * (1.0 - t) / (1.0 - flatness) * x.yz) -
                 shift;
  return h + strength * (stepped - h);
}

// Distance to the edge of a domain about the origin, of these half sizes.
vec3 inside_distance(vec2 place, vec2 half_size, bool is_round) {
  if (is_round) {
    vec2 q = place / half_size;
    float r = max(length(q), 1e-6);
    float least = min(half_size.x, half_size.y);
    return vec3((1.0 - r) * least, -least * q / (r * half_size));
  }
  vec2 side = half_size - abs(place);
  return side.x < side.y ? vec3(side.x, -sign(place.x), 0.0) : vec3(side.y, 0.0, -sign(place.y));
}

vec3 fallen_off(vec3 h, vec3 inside, vec3 noise, float level, float width, float irregularity) {
  vec3 shift = irregularity * soft_threshold(0.5, 1.0, vec3(0.5, 0.0, 0.0) + 0.7 * noise);
  vec3 share = soft_threshold(0.5, 1.0, (inside - shift) / width);
  return level_ground(level) + product(share, h - level_ground(level));
}

vec3 bent_by_power(vec3 h, float low, float extent, float exponent) {
  float t = (h.x - low) / extent;
  float size = max(abs(t), 1e-9);
  return vec3(low + extent * sign(t) * pow(size, exponent),
              exponent * pow(size, exponent - 1.0) * h.yz);
}
