// Where a vertex of a plant is at a share of its leaves (raster/plant_levels.hpp).

const float plant_fade = 0.25;
const float aspect_strip = 15000.0;  // from here on changes in width alone

vec3 turned_by(vec4 q, vec3 v) {
  vec3 t = 2.0 * cross(q.xyz, v);
  return v + q.w * t + cross(q.xyz, t);
}

// Mean over ranks of f^power.
float plant_kept(float share, float power) {
  float fade = plant_fade * share;
  float cut = clamp((share + fade - 1.0) / fade, 0.0, 1.0);
  return share + fade / (power + 1.0) * (1.0 - pow(cut, power + 1.0));
}

// In the model. `fade`: part of the leaves that is drawn at all, without the others growing for it;
// `growth`: in area, for plants that were left out.
vec3 plant_place(vec3 position, vec4 across, vec4 along, float share, float fade, float growth) {
  float aspect = across.w;
  float rank = along.w;
  if (fade < 1.0 && (aspect == 0.0 ? fade < 0.5 : rank > fade * share * (1.0 + plant_fade)))
    return vec3(0.0);
  if (aspect == 0.0) return position;
  float f = clamp((share * (1.0 + plant_fade) - rank) / (plant_fade * share), 0.0, 1.0);
  bool strip = aspect > aspect_strip;
  float grown = growth / plant_kept(share, strip ? 1.0 : 2.0);
  float both = sqrt(max(1.0, grown / aspect));
  float wide = min(grown, aspect) * both;
  return position + (f * wide - 1.0) * across.xyz + (f * both - 1.0) * along.xyz;
}
