// Woods from the air: crowns stand over the ground where there are trees, hide what is behind them
// and shade each other. Seen from so far that a crown is less than a pixel, only their mean is left.
#include "landscape/ground.glsl"

// What is lit at a place: colour, normal, and the shares of sky and sun that it sees.
struct Lit {
  vec3 albedo;
  vec3 normal;
  float open;
  float sunlit;
  float crown;  // share of it that is a tree's crown
};

#if HAS_WOODS
const float TREE_SPACING = 7.0;  // m
const int CROWN_STEPS = 64;

struct Crown {
  float height;  // over the ground, m; 0 between trees
  vec2 slope;
  float tone;    // of its colour, 0 to 1
  float steep;   // the steepest of those over the place
  float gap;     // until the next may begin, m
};

// The crown over a place, where this share of the ground is under trees, and how far it is to the
// next along a way (unit).
Crown crown_over(vec2 place, float share, vec2 way) {
  vec2 p = place / TREE_SPACING;
  vec2 below = floor(p);
  vec2 t = p - below;
  ivec2 cell = ivec2(below);
  // Trees of the cells beyond those looked at begin no nearer.
  vec2 leaving = mix(t, 1.0 - t, greaterThan(way, vec2(0.0))) / max(abs(way), vec2(1e-4));
  float sure = TREE_SPACING * (min(leaving.x, leaving.y) + 0.4);
  Crown best = Crown(0.0, vec2(0.0), 0.0, 0.0, sure);
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
    bool pointed = float((h * 2891336453u) >> 8u) / 16777216.0 < CONIFERS;
    vec3 size = pointed ? CONIFER_SIZE : BROADLEAF_SIZE;
    float top = mix(size.x, size.y, r.z);
    float radius = size.z * top;
    float d = length(away) / radius;
    if (d >= 1.0) {
      float ahead = -dot(away, way);
      float deep = radius * radius - dot(away, away) + ahead * ahead;
      if (ahead > 0.0 && deep > 0.0) best.gap = min(best.gap, ahead - sqrt(deep));
      continue;
    }
    float round_off = sqrt(1.0 - d * d);
    float height = pointed ? top * (1.0 - 0.92 * d) : top * (0.15 + 0.85 * round_off);
    float fall = pointed ? 0.92 * top : min(0.85 * top * d / max(round_off, 0.2), 3.0 * top);
    best.steep = max(best.steep, fall / radius);
    if (height <= best.height) continue;
    best.height = height;
    best.slope = -fall / radius * away / max(length(away), 1e-3);
    best.tone = clamp((pointed ? 0.0 : 0.4) + 0.6 * fract(41.0 * other), 0.0, 1.0);
  }
  return best;
}

// Share of the sun that comes through the crowns around, to a height over the ground.
float sun_through_crowns(vec2 place, float height, vec3 wide, vec3 sun, float share) {
  float across = max(length(sun.xy), 1e-3);
  vec2 sunward = sun.xy / across;
  float climb = max(sun.z / across - dot(wide.yz, sunward), 0.05);
  float reach = min((TREE_TOP - height) / climb, 5.0 * TREE_SPACING);
  float lit = 1.0;
  for (int k = ZERO; k < 6; ++k) {
    float s = reach * (float(k) + 0.5) / 6.0;
    float hidden = crown_over(place + s * sunward, share, sunward).height - height - climb * s;
    lit = min(lit, 1.0 - 0.85 * smoothstep(-0.5, 2.0, hidden));
  }
  return lit;
}

// Trees are seen one by one where a pixel is smaller, m.
const float TREES_UP_TO = 4.5;

// The way of a ray from the height of the tallest trees to the land that it meets, m.
float way_through_trees(vec3 wide, vec3 direction) {
  return TREE_TOP / max(dot(wide.yz, direction.xy) - direction.z, 0.1);
}

// The trees before the ground that a ray meets at a place; `wide` is the land's height there, with
// slope, `bend` how much higher than so it is where the ray comes in above the trees, m.
Lit with_trees(Lit ground, vec2 place, vec3 wide, float bend, vec3 direction, vec3 sun,
               float pixel) {
  float near = 1.0 - smoothstep(0.3 * TREES_UP_TO, TREES_UP_TO, pixel);
  float slope = degrees(atan(length(wide.yz)));
  float share = woods(place, slope, wide.x, pixel);
  float length_inside = way_through_trees(wide, direction);
  float across = max(length(direction.xy), 1e-3);
  float before = woods(place - length_inside * direction.xy, slope, wide.x, pixel);
#if HAS_TREE_MAP
  // Some that stand between, where none stand at either end.
  float along_share = woods_on_map(place - 0.5 * length_inside * direction.xy,
                                   max(length_inside * across, pixel));
  before = max(before, 0.5 * along_share);
#endif
  if (near <= 0.0 || max(share, before) <= 0.0) return ground;

  Crown crown = Crown(0.0, vec2(0.0), 0.0, 0.0, 0.0);
  vec2 at = place;
  // Down from the height of the tallest: from crown to crown, over one as far as its slope allows;
  // the step that meets it is halved.
  float left = 1.0;
  float along = length_inside * across;
  float stride = 0.0;
  int halvings = 0;
  for (int k = ZERO; k < CROWN_STEPS && left > -0.001 && halvings < 5; ++k) {
    at = place - left * length_inside * direction.xy;
    float over = left * TREE_TOP - left * left * bend;
    Crown met = crown_over(at, mix(share, before, left), direction.xy / across);
    bool inside = met.height > 0.0 && met.height >= over;
    if (inside) crown = met;
    if (inside || halvings > 0) {
      ++halvings;
      stride *= 0.5;
      left += inside ? stride : -stride;
    } else {
      stride = max(met.gap, 0.1);
      if (met.height > 0.0) {
        float closing = met.steep + TREE_TOP / along;
        stride = min(stride, max(0.9 * (over - met.height) / closing, 0.25));
      }
      stride /= along;
      left -= min(stride, max(left, 0.02));
    }
  }
  if (crown.height <= 0.0) {
    ground.open *= mix(1.0, 0.6, near * min(share, 1.0));
    ground.sunlit *= mix(1.0, sun_through_crowns(place, 0.0, wide, sun, share), near);
    return ground;
  }
  // Clumps of leaves.
  vec3 leaf = vec3(at, crown.height);
  vec4 leaves = octave_weight(pixel / 3.5) * gradient_noise(leaf / 3.5, 35u) +
                0.7 * octave_weight(pixel / 1.1) * gradient_noise(leaf / 1.1, 36u);
  vec3 normal = normalize(vec3(-wide.yz - 0.5 * crown.slope - 1.3 * leaves.yz, 1.0));
  float lit = sun_through_crowns(at, crown.height + 0.5, wide, sun, share);
  vec3 color = 1.55 * mix(CANOPY_COLOR_1, CANOPY_COLOR_2, crown.tone) * (1.0 + 0.8 * leaves.x);
  float open = mix(0.35, 1.0, smoothstep(0.15, 0.8, crown.height / TREE_TOP));
  return Lit(mix(ground.albedo, color, near), normalize(mix(ground.normal, normal, near)),
             ground.open * mix(1.0, open, near), ground.sunlit * mix(1.0, lit, near), near);
}
#endif
