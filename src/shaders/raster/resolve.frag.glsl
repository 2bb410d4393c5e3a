// The new frame and those before it (temporal anti-aliasing): each frame is moved by a part of a
// pixel, and the mean of many has smooth edges.
//
// While the camera stands still the mean is exact. While it moves, what was seen is found where it
// stood in the last frame and held within the colours about it in this one: B. Karis, "High-quality
// temporal supersampling", SIGGRAPH 2014; in a space where brightness is compressed, so that one
// bright sample doesn't rule.
#include "raster/picture.glsl"

uniform sampler2D frame;
uniform sampler2D history;
uniform mat4 last_view_projection;
uniform float share;  // of the new frame
uniform bool still;   // the camera has not moved since the history was begun

in vec2 screen_place;
out vec4 result;

vec4 compressed(vec4 c) {
  return vec4(c.rgb / (1.0 + dot(c.rgb, vec3(0.2126, 0.7152, 0.0722)) * 1e-3), c.a);
}
vec4 expanded(vec4 c) {
  return vec4(c.rgb / max(1.0 - dot(c.rgb, vec3(0.2126, 0.7152, 0.0722)) * 1e-3, 1e-3), c.a);
}

void main() {
  vec4 now = texture(frame, screen_place);
  if (still) {
    result = mix(texture(history, screen_place), now, share);
    return;
  }
  vec3 ray = view_ray(screen_place);
  float depth = view_depth(screen_place);
  vec4 place = depth < 0.0 ? vec4(ray, 0.0) : vec4(eye + depth * ray, 1.0);
  vec4 then = last_view_projection * place;
  vec2 at = 0.5 + 0.5 * then.xy / then.w;
  if (then.w <= 0.0 || any(lessThan(at, vec2(0.0))) || any(greaterThan(at, vec2(1.0)))) {
    result = now;
    return;
  }
  vec2 pixel = 1.0 / vec2(textureSize(frame, 0));
  vec4 sum = vec4(0.0);
  vec4 squares = vec4(0.0);
  for (int j = -1; j <= 1; ++j)
    for (int i = -1; i <= 1; ++i) {
      vec4 c = compressed(texture(frame, screen_place + pixel * vec2(float(i), float(j))));
      sum += c;
      squares += c * c;
    }
  vec4 mean = sum / 9.0;
  vec4 spread = 1.25 * sqrt(max(squares / 9.0 - mean * mean, vec4(0.0)));
  vec4 before = clamp(compressed(texture(history, at)), mean - spread, mean + spread);
  result = expanded(mix(before, compressed(now), max(share, 0.08)));
}
