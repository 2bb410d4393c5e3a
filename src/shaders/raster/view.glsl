// What DrawView sets (raster/draw_view.hpp).

uniform mat4 view_projection;  // world to clip space
uniform vec3 eye;              // m
uniform float pixel_angle;     // radians

// Metres that a pixel of the camera covers at a place, at right angles to the view.
float pixel_size(vec3 place) {
  return pixel_angle * distance(place, eye);
}
