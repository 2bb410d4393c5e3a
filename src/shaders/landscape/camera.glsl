// Where the eye is: on a straight flight over the land that follows its height, or wherever the
// program that shows the picture says (LANDSCAPE_CAMERA).
#include "terrain/steps.glsl"

struct View {
  vec2 place;
  float height;
  vec3 forward;
  vec3 right;
  vec3 up;
};

#ifdef LANDSCAPE_CAMERA
uniform vec4 camera_place;  // east, north, height; w: 1 above the land, 0 above its zero
uniform vec3 camera_forward;
uniform vec3 camera_right;
#endif

// Height of the land as a flight follows it: smooth, and never below what is near.
float followed_land(vec2 place, vec2 heading) {
  float reach = 2.5 * CAM_HEIGHT + 300.0;
  float spacing = 0.25 * reach;
  float sum = 0.0;
  float weights = 0.0;
  float near = 0.0;
  for (int k = ZERO - 4; k <= 4; ++k) {
    bool here = k == -4;
    float x = here ? 0.0 : float(k) * 0.28;
    float ground = terrain(place + heading * (x * reach), here ? 0.2 * spacing : spacing).x;
    float weight = here ? 0.0 : exp(-1.5 * x * x);
    if (here) near = ground - 0.6 * CAM_HEIGHT;
    sum += weight * ground;
    weights += weight;
  }
  return soft_higher(vec3(sum / weights, 0.0, 0.0), vec3(near, 0.0, 0.0), CAM_HEIGHT).x;
}

View landscape_view(vec2 resolution, vec4 mouse, float time) {
  float azimuth = radians(CAM_DIRECTION);
  vec2 heading = vec2(sin(azimuth), cos(azimuth));
#ifdef LANDSCAPE_CAMERA
  vec2 place = camera_place.xy;
  float height = camera_place.z;
  if (camera_place.w > 0.5) height += followed_land(place, heading);
  return View(place, height, camera_forward, camera_right, cross(camera_right, camera_forward));
#else
  vec2 place = vec2(CAM_EAST, CAM_NORTH) + CAM_SPEED * time * heading;
  float height = followed_land(place, heading) + CAM_HEIGHT;
  float tilt = radians(CAM_TILT);
  if (mouse.x + mouse.y > 0.0) {
    azimuth += 6.2832 * (mouse.x / resolution.x - 0.5);
    tilt += 2.4 * (mouse.y / resolution.y - 0.5);
  }
  tilt = clamp(tilt, -1.5, 1.5);
  vec3 forward = vec3(cos(tilt) * sin(azimuth), cos(tilt) * cos(azimuth), sin(tilt));
  vec3 right = vec3(cos(azimuth), -sin(azimuth), 0.0);
  return View(place, height, forward, right, cross(right, forward));
#endif
}

vec3 view_ray(View view, vec2 pixel, vec2 resolution) {
  vec2 from_middle = (2.0 * pixel - resolution) / max(resolution.x, resolution.y);
  vec2 p = tan(0.5 * radians(FIELD_OF_VIEW)) * from_middle;
  return normalize(view.forward + p.x * view.right + p.y * view.up);
}
