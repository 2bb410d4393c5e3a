// What the land hides of sun and sky (raster/terrain_shade.hpp).

uniform sampler2D sun_edges_field;   // heights where the sun begins to rise and has risen, m
uniform sampler2D sun_edges_around;
uniform sampler2D sky_shares;        // over the field, over the surroundings
// Of sun, sun around, sky, sky around: origin, cells per metre, whether there is one.
uniform vec4 terrain_shade_places[4];

// Between four samples; false outside.
bool shade_at(sampler2D map, vec4 where, vec2 place, out vec2 value) {
  vec2 at = (place - where.xy) * where.z;
  ivec2 last = textureSize(map, 0) - 1;
  value = vec2(0.0);
  if (where.w == 0.0 || any(lessThan(at, vec2(0.0))) || any(greaterThan(at, vec2(last))))
    return false;
  ivec2 p = min(ivec2(at), last - 1);
  vec2 t = at - vec2(p);
  vec2 south = mix(texelFetch(map, p, 0).xy, texelFetch(map, p + ivec2(1, 0), 0).xy, t.x);
  vec2 north =
      mix(texelFetch(map, p + ivec2(0, 1), 0).xy, texelFetch(map, p + ivec2(1, 1), 0).xy, t.x);
  value = mix(south, north, t.y);
  return true;
}

// Part of the sun that a place sees past the land.
float terrain_sun_share(vec3 place) {
  vec2 edges;
  if (!shade_at(sun_edges_field, terrain_shade_places[0], place.xy, edges) &&
      !shade_at(sun_edges_around, terrain_shade_places[1], place.xy, edges))
    return 1.0;
  float t = clamp((place.z - edges.x) / max(edges.y - edges.x, 1e-3), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

// Part of the sky's light that reaches a place, out of what its slope would have alone.
float terrain_sky_share(vec3 place) {
  vec2 share;
  if (shade_at(sky_shares, terrain_shade_places[2], place.xy, share)) return share.x;
  if (shade_at(sky_shares, terrain_shade_places[3], place.xy, share)) return share.y;
  return 1.0;
}
