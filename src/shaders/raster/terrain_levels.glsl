// Twin of TerrainChoice (raster/terrain_levels.hpp): places of vertices, m from the anchor.

uniform vec2 terrain_eye;        // m from the anchor
uniform float terrain_unit;      // m, of the lattice
uniform float terrain_nearest;   // D, m
uniform float terrain_reach;     // k
uniform float terrain_morph;     // a
uniform float terrain_coarsest;  // step that never morphs

float terrain_distance(vec2 place) {
  return max(distance(place, terrain_eye), terrain_nearest);
}

// Vertex `at` of a tile: its corner and step, on the lattice.
vec2 terrain_vertex(vec3 tile, vec2 at) {
  vec2 still = tile.xy + tile.z * at;
  if (tile.z >= terrain_coarsest) return still * terrain_unit;
  float end = 2.0 * terrain_reach * tile.z * terrain_unit;
  float d = terrain_distance(still * terrain_unit) / end;
  float m = clamp((d - terrain_morph) / (1.0 - terrain_morph), 0.0, 1.0);
  vec2 odd = mod(at, 2.0);
  return (tile.xy + tile.z * (at - m * odd)) * terrain_unit;
}

// m between vertices that a place needs: what the octaves of its height go by.
float terrain_spacing(vec2 place) {
  return terrain_distance(place) / terrain_reach;
}
