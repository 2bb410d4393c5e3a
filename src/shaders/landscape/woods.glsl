// Woods from the air: crowns stand over the ground where there are trees, hide what is behind them
// and shade each other. Seen from so far that a crown is less than a pixel, only their mean is left.
#include "landscape/ground.glsl"

const float TREE_SPACING = 7.0;  // m
const float TREE_TOP = 19.0;     // m, none is higher
const int CROWN_STEPS = 36;

struct Crown {
  float height;  // over the ground, m; 0 between trees
  vec2 slope;
  float tone;    // of its colour, 0 to 1
  float gap;     // to the next crown's edge, m; no more than is sure
};

// The crown over a place, where this share of the ground is under trees.
Crown crown_over(vec2 place, float share) {
  vec2 p = place / TREE_SPACING;
  vec2 below = floor(p);
  vec2 t = p - below;
  ivec2 cell = ivec2(below);
  Crown best = Crown(0.0, vec2(0.0), 0.0, 0.4 * TREE_SPACING);
  for (int k = ZERO; k < 9; ++k) {
    ivec2 step = ivec2(k % 3, k / 3) - 1;
    uint h = lattice_hash(uint(cell.x + step.x), lattice_line(uint(cell.y + step.y), 71u));
    vec3 r = vec3(uvec3(h, h >> 10u, h >> 20u) & 1023u) / 1024.0;
    float other = float((h * 747796405u) >> 8u) / 16777216.0;
    vec2 foot = vec2(step) + 0.15 + 0.7 * r.xy;
#if HAS_TREE_MAP
    share = woods_on_map(TREE_SPACING * (below + foot), TREE_SPACING);
#endif
    if (other >= 1.15 * share) continue;
    vec2 away = TREE_SPACING * (t - foot);
    bool pointed = fract(13.0 * other) < 0.5;
    float radius = TREE_SPACING * (pointed ? 0.3 + 0.18 * r.z : 0.42 + 0.3 * r.z);
    float d = length(away) / radius;
    best.gap = min(best.gap, max(radius * (d - 1.0), 0.0));
    if (d >= 1.0) continue;
    float top = TREE_TOP * (0.55 + 0.45 * r.z * (0.4 + 0.6 * min(share, 1.0)));
    float round_off = sqrt(1.0 - d * d);
    float height = pointed ? top * (1.0 - 0.85 * d) : top * (0.3 + 0.45 * round_off);
    if (height <= best.height) continue;
    float fall = pointed ? 0.85 * top : min(0.45 * top * d / max(round_off, 0.2), 2.0 * top);
    best = Crown(height, -fall / radius * away / max(length(away), 1e-3),
                 clamp((pointed ? 0.0 : 0.4) + 0.6 * fract(41.0 * other), 0.0, 1.0), best.gap);
  }
  return best;
}

// What is lit at a place: colour, normal, and the shares of sky and sun that it sees.
struct Lit {
  vec3 albedo;
  vec3 normal;
  float open;
  float sunlit;
};

// The trees before the ground that a ray meets at a place; `wide` is the land's height there, with
// slope.
Lit with_trees(Lit ground, vec2 place, vec3 wide, vec3 direction, vec3 sun, float pixel) {
  float near = 1.0 - smoothstep(1.5, 4.5, pixel);
  float slope = degrees(atan(length(wide.yz)));
  float share = woods(place, slope, wide.x, pixel);
  float sinking = max(dot(wide.yz, direction.xy) - direction.z, 0.1);
  float length_inside = TREE_TOP / sinking;
  float before = woods(place - length_inside * direction.xy, slope, wide.x, pixel);
  if (near <= 0.0 || max(share, before) <= 0.0) return ground;

  Crown crown = Crown(0.0, vec2(0.0), 0.0, 0.0);
  vec2 at = place;
  // Down from the height of the tallest: from crown to crown, within one's circle by a share of the
  // height over it; the step that meets it is halved.
  float left = 1.0;
  float along = length_inside * max(length(direction.xy), 1e-3);
  float stride = 0.0;
  int halvings = 0;
  for (int k = ZERO; k < CROWN_STEPS && left > -0.001 && halvings < 5; ++k) {
    at = place - left * length_inside * direction.xy;
    float over = left * TREE_TOP;
    Crown met = crown_over(at, mix(share, before, left));
    bool inside = met.height > 0.0 && met.height >= over;
    if (inside) crown = met;
    if (inside || halvings > 0) {
      ++halvings;
      stride *= 0.5;
      left += inside ? stride : -stride;
    } else {
      float within = max(0.5 * (over - met.height) / TREE_TOP, 0.5 / along);
      stride = met.gap > 0.0 ? max(met.gap, 0.1) / along : within;
      left -= min(stride, max(left, 0.02));
    }
  }
  if (crown.height <= 0.0) {
    ground.open *= mix(1.0, 0.6, near * share);
    return ground;
  }
  float leaves = patches(at + vec2(0.0, crown.height), 1.6, pixel, 2, 35u);
  vec3 normal = normalize(vec3(-wide.yz - 0.55 * crown.slope, 1.0));
  // The sun through neighbouring crowns.
  float lit = 1.0;
  vec2 sunward = sun.xy / max(length(sun.xy), 1e-3);
  float climb = sun.z / max(length(sun.xy), 1e-3) - dot(wide.yz, sunward);
  for (int k = ZERO; k < 4; ++k) {
    float s = 1.2 + 2.4 * float(k);
    float hidden = crown_over(at + s * sunward, share).height - crown.height - climb * s;
    lit = min(lit, 1.0 - 0.8 * clamp(hidden / 2.0, 0.0, 1.0));
  }
  vec3 color = 1.55 * mix(CANOPY_COLOR_1, CANOPY_COLOR_2, crown.tone) * (1.0 + 0.5 * leaves);
  float open = mix(0.35, 1.0, smoothstep(0.15, 0.8, crown.height / TREE_TOP));
  return Lit(mix(ground.albedo, color, near), normalize(mix(ground.normal, normal, near)),
             ground.open * mix(1.0, open, near), ground.sunlit * mix(1.0, lit, near));
}
