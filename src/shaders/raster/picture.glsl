// From a pixel of the depth buffer back to the world (raster/draw_view.hpp).

uniform sampler2D depth_picture;
uniform vec2 depth_range;  // depth = x + y · depth as stored
uniform vec3 eye;          // m
uniform vec3 forward;      // of the ray through the middle
uniform vec3 right;        // added at the right edge
uniform vec3 above;        // added at the upper edge
uniform float nearest;     // m

// Not of unit length: one along `forward`.
vec3 view_ray(vec2 screen_place) {
  vec2 at = 2.0 * screen_place - 1.0;
  return forward + at.x * right + at.y * above;
}

// Metres along `forward`; negative where nothing is drawn.
float view_depth(vec2 screen_place) {
  float depth = depth_range.x + depth_range.y * texture(depth_picture, screen_place).r;
  return depth > 0.0 ? nearest / depth : -1.0;
}
