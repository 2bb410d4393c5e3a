// The ground: a vertex of a tile, moved to its place and raised to its height.
#include "raster/view.glsl"
#include "raster/terrain_levels.glsl"
#include "render/ground_heights.glsl"

layout(location = 0) in vec2 grid_corner;
layout(location = 1) in vec3 tile;

uniform vec2 ground_high;      // end of the modelled square, m from the anchor
uniform mat4 from_eye;         // view_projection of what is relative to the eye

out vec2 place;    // m from the anchor
out float height;  // m
out float lift;    // m, of surroundings

void main() {
  place = min(terrain_vertex(tile, grid_corner), ground_high);
  lift = ground_lift(place);
  height = ground_detailed(place, lift, terrain_spacing(place)).x;
  gl_Position = from_eye * vec4(place - terrain_eye, height - eye.z, 1.0);
}
