// What is baked texel by texel.

// The place of this texel of a strip that wraps round a texture of `size`.
vec2 strip_place(int size) {
  ivec2 texel = ivec2(gl_FragCoord.xy);
  return vec2(strip_low + ((texel - strip_low) & (size - 1))) * strip_cell;
}

vec4 height_texel() {
  vec2 place = strip_place(ring_size);
  return vec4(terrain(place, max(finest_spacing(OCTAVES), strip_cell)), 0.0);
}

// A cubic patch lies below the highest of its control points in Bernstein's form.
float corner_maximum(vec3 corner, vec2 inward) {
  vec2 rise = corner.yz * inward * (strip_cell / 3.0);
  return corner.x + max(max(rise.x, rise.y), max(rise.x + rise.y, 0.0));
}
float patch_maximum() {
  ivec2 low = ivec2(gl_FragCoord.xy);
  ivec2 high = (low + 1) & (ring_size - 1);
  vec3 a = texelFetch(ring_heights, ivec3(low, strip_level), 0).xyz;
  vec3 b = texelFetch(ring_heights, ivec3(high.x, low.y, strip_level), 0).xyz;
  vec3 c = texelFetch(ring_heights, ivec3(low.x, high.y, strip_level), 0).xyz;
  vec3 d = texelFetch(ring_heights, ivec3(high, strip_level), 0).xyz;
  return max(max(corner_maximum(a, vec2(1.0, 1.0)), corner_maximum(b, vec2(-1.0, 1.0))),
             max(corner_maximum(c, vec2(1.0, -1.0)), corner_maximum(d, vec2(-1.0, -1.0))));
}

float higher_maximum() {
  ivec2 low = 2 * ivec2(gl_FragCoord.xy);
  float a = texelFetch(ring_maxima, ivec3(low, strip_level), 0).r;
  float b = texelFetch(ring_maxima, ivec3(low + ivec2(1, 0), strip_level), 0).r;
  float c = texelFetch(ring_maxima, ivec3(low + ivec2(0, 1), strip_level), 0).r;
  float d = texelFetch(ring_maxima, ivec3(low + 1, strip_level), 0).r;
  return max(max(a, b), max(c, d));
}

void sky_texel(vec2 texel, out vec4 by_air, out vec4 by_aerosol, out vec4 passed) {
  float height = texelFetch(frame_view, ivec2(0, 0), 0).z;
  AirRay ray = sky_entry(texel, vec2(textureSize(sky_by_air, 0)), height, frame_light().direction);
  ScatteredSums sums = tabled_air(ray, 1e9, 24);
  by_air = vec4(sums.by_air * rayleigh_phase(ray.to_sun) + sums.multiple, 1.0);
  by_aerosol = vec4(sums.by_aerosol, 1.0);
  passed = vec4(sums.transmittance, 1.0);
}
