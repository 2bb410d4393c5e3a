// Where a direction stands in the table of class Sky (sky/sky_table.hpp), as a texture of 512 x 257
// nodes, repeated along x.

vec2 sky_table_place(vec3 direction) {
  float across = length(direction.xy);
  float steep = abs(direction.z) / max(abs(direction.z) + across, 1e-30);
  float s = direction.z < 0.0 ? -sqrt(steep) : sqrt(steep);
  float t = direction.y / max(abs(direction.x) + abs(direction.y), 1e-30);
  float turn = direction.x < 0.0 ? 2.0 - t : (t < 0.0 ? 4.0 + t : t);
  return vec2((turn * 128.0 + 0.5) / 512.0, (128.0 * (s + 1.0) + 0.5) / 257.0);
}
