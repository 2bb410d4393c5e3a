// Lines in the world, as ribbons of a few pixels (view/line_drawing.hpp).
#include "raster/view.glsl"

layout(location = 0) in vec3 from;
layout(location = 1) in vec3 to;
layout(location = 2) in vec3 radiance;

uniform float width;  // pixels

out vec3 light;

void main() {
  // Six corners of two triangles: along 0 or 1, side -1 or 1.
  float along = gl_VertexID == 1 || gl_VertexID == 2 || gl_VertexID == 4 ? 1.0 : 0.0;
  float side = gl_VertexID == 2 || gl_VertexID == 4 || gl_VertexID == 5 ? 1.0 : -1.0;
  vec3 place = mix(from, to, along);
  vec3 across = normalize(cross(to - from, place - eye) + vec3(1e-12));
  place += across * (side * 0.5 * width * pixel_size(place));
  // A little nearer, so that a line along a surface is seen.
  place = mix(place, eye, 1e-3);
  light = radiance;
  gl_Position = view_projection * vec4(place, 1.0);
}
