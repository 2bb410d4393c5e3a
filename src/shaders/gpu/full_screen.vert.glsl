// One triangle that covers the whole target, without any vertices given.

out vec2 screen_place;  // from 0 at the bottom left to 1

void main() {
  vec2 corner = vec2((gl_VertexID << 1) & 2, gl_VertexID & 2);
  screen_place = corner;
  gl_Position = vec4(corner * 2.0 - 1.0, 0.0, 1.0);
}
