// Twin of noise/lattice.hpp: the same bits in `uint`. Four hashes go together, the corners of a
// cell in a plane.

uint mix_bits32(uint h) {
  h ^= h >> 16u;
  h *= 0x21f0aaadu;
  h ^= h >> 15u;
  h *= 0xd35a2d97u;
  return h ^ (h >> 15u);
}
uvec4 mix_bits32(uvec4 h) {
  h ^= h >> 16u;
  h *= 0x21f0aaadu;
  h ^= h >> 15u;
  h *= 0xd35a2d97u;
  return h ^ (h >> 15u);
}

uint lattice_key(uint seed) {
  return mix_bits32(seed + 0x9e3779b9u);
}

uint lattice_line(uint coordinate, uint key) {
  uint h = (coordinate * 0x85ebca77u) ^ key;
  h ^= h >> 15u;
  h *= 0xc2b2ae3du;
  return h ^ (h >> 16u);
}

uint lattice_hash(uint x, uint row) {
  return mix_bits32((x * 0x9e3779b1u) ^ row);
}

// Of the points (x, row), (x + 1, row), (x, next_row), (x + 1, next_row).
uvec4 lattice_hashes(uint x, uint row, uint next_row) {
  uint here = x * 0x9e3779b1u;
  uint next = here + 0x9e3779b1u;
  return mix_bits32(uvec4(here, next, here, next) ^ uvec4(row, row, next_row, next_row));
}

// The corners of the cell in a plane: (0, 0), (1, 0), (0, 1), (1, 1).
uvec4 lattice_corners(uint x, uint y, uint plane) {
  return lattice_hashes(x, lattice_line(y, plane), lattice_line(y + 1u, plane));
}

vec4 with_signs(vec4 v, uvec4 signs) {
  return uintBitsToFloat(floatBitsToUint(v) | (signs & 0x80000000u));
}

// Directions (0.981, 0.195), (0.831, 0.556), (0.556, 0.831), (0.195, 0.981) times gradient2_scale:
// the first two by the exclusive or of both bits, turned about by the upper one.
void lattice_gradients2(uvec4 hash, out vec4 x, out vec4 y) {
  bvec4 inner = notEqual((hash ^ (hash >> 1u)) & 0x10000000u, uvec4(0u));
  bvec4 upper = notEqual(hash & 0x20000000u, uvec4(0u));
  vec4 a = mix(vec4(1.41048467), vec4(1.19575107), inner);
  vec4 b = mix(vec4(0.280562848), vec4(0.798975348), inner);
  x = with_signs(mix(a, b, upper), hash);
  y = with_signs(mix(b, a, upper), hash << 1u);
}

// (1, 1, 1)/√3, (q, p, p), (p, q, p), (p, p, q) times gradient3_scale.
void lattice_gradients3(uvec4 hash, out vec4 x, out vec4 y, out vec4 z) {
  uvec4 which = (hash >> 27u) & 3u;
  vec4 rest = mix(vec4(0.346219391), vec4(0.666665971), equal(which, uvec4(0u)));
  const vec4 most = vec4(1.04575086);
  x = with_signs(mix(rest, most, equal(which, uvec4(1u))), hash);
  y = with_signs(mix(rest, most, equal(which, uvec4(2u))), hash << 1u);
  z = with_signs(mix(rest, most, equal(which, uvec4(3u))), hash << 2u);
}

vec4 lattice_values(uvec4 hash) {
  return vec4(ivec4(hash)) * 4.65660815e-10;
}
