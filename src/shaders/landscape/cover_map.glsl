// What lies on the land where maps say so, and where trees stand.

#if HAS_COVERS
uniform sampler2D cover_map;  // square roots of colours; share
#endif
#if HAS_TREE_MAP
uniform sampler2D tree_map;   // share of the ground under trees
#endif

vec4 map_texel(sampler2D map, vec2 place, float footprint) {
  vec2 at = (on_map(place / TERRAIN_SCALE).at + 0.5) / vec2(textureSize(height_map, 0));
  return textureLod(map, at, log2(max(footprint / (TERRAIN_SCALE * MAP_CELL), 1.0)));
}
