// A rectangle with a plant's picture, turned about its stem towards the eye.
#include "raster/plant_place.glsl"
#include "raster/view.glsl"

layout(location = 0) in vec2 corner;
layout(location = 6) in vec4 plant_at;     // m; w: scale
layout(location = 7) in vec4 plant_turn;   // quaternion
layout(location = 8) in vec4 plant_share;  // y: part drawn; zw: uniform numbers

uniform mat4 from_eye;
uniform vec4 towards_viewer;  // w: 1 where rays are parallel
uniform vec4 card_shape;      // m: radius, foot, top; tint

const float pi2 = 6.2831853;
const vec2 card_elevations = vec2(0.08, 0.75);

out vec3 place;
out vec2 card_place;  // m, from the middle
flat out vec4 turn;
flat out vec4 individual;
// Of the pictures: number of the first, its other neighbour's share, share of the higher row, drawn
// part.
flat out vec4 pictures;

float half_height(float elevation) {
  return 0.5 * (card_shape.z - card_shape.y) * cos(elevation) + card_shape.x * sin(elevation);
}

void main() {
  vec3 middle = vec3(0.0, 0.0, 0.5 * (card_shape.y + card_shape.z));
  vec3 centre = plant_at.xyz - eye + plant_at.w * turned_by(plant_turn, middle);
  vec3 towards = towards_viewer.w > 0.0 ? towards_viewer.xyz : -normalize(centre);
  vec3 own = turned_by(vec4(-plant_turn.xyz, plant_turn.w), towards);
  float elevation = clamp(asin(clamp(own.z, -1.0, 1.0)), 0.0, 1.2);
  float azimuth = atan(own.y, own.x);
  vec3 right = vec3(-sin(azimuth), cos(azimuth), 0.0);
  vec3 up = cross(vec3(cos(elevation) * cos(azimuth), cos(elevation) * sin(azimuth), sin(elevation)),
                  right);
  vec2 size = vec2(card_shape.x, max(half_height(elevation), card_shape.x));
  card_place = corner * size;
  vec3 offset = card_place.x * right + card_place.y * up;
  vec3 at = centre + plant_at.w * turned_by(plant_turn, offset);
  // Towards a sun (its rays are parallel) the crown reaches further than the picture: so it shades
  // what is under it as well.
  at += towards * (0.9 * towards_viewer.w * card_shape.x * plant_at.w);
  gl_Position = from_eye * vec4(at, 1.0);
  place = eye + at;
  turn = plant_turn;
  individual = plant_share;
  float step = fract(azimuth / pi2 + 1.0) * 8.0;
  float higher = clamp((elevation - card_elevations.x) / (card_elevations.y - card_elevations.x), 0.0,
                       1.0);
  pictures = vec4(floor(step), fract(step), higher, plant_share.y);
}
