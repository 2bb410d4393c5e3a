// One pixel in four is new each frame, seen through another place within it each round of four; the
// picture is what they add up to, carried along with eye and wind (Karis, "High-quality temporal
// supersampling", SIGGRAPH 2014).

uniform ivec2 turn;        // which of each four pixels is new
uniform vec2 shift;        // of its place from the pixel's middle, pixels
uniform highp sampler2D land_picture;  // of new pixels: radiance times exposure; distance, -1 for sky
uniform highp sampler2D new_picture;   // with clouds; distance, below 0 of what the wind moves
uniform highp sampler2D history;       // radiance times exposure; samples that it is the mean of
uniform bool has_history;
uniform bool same_view;    // the history is of this very moment
uniform bool still;        // the camera stands
uniform float most_samples;

const float sky_distance = 1e6;  // m

// Where a new pixel is seen through.
vec2 new_pixel(ivec2 cell, vec2 resolution) {
  return min(vec2(2 * cell + turn), resolution - 1.0) + 0.5 + shift;
}

// Where what is seen now at a pixel, so far away and moved by the wind, was seen last; in pixels.
vec2 last_pixel(vec2 pixel, vec2 resolution, float away, float wind) {
  View view = seen_from(frame_view);
  View last = seen_from(last_view);
  vec3 to = view_ray(view, pixel, resolution) * away;
  to.xy += view.place - last.place - vec2(wind, 0.0);
  to.z += view.height - last.height;
  float depth = dot(to, last.forward);
  if (depth <= 0.0) return vec2(-1e4);
  vec2 p = vec2(dot(to, last.right), dot(to, last.up)) / (depth * last_half_width());
  return 0.5 * (p * max(resolution.x, resolution.y) + resolution);
}

// Catmull-Rom's cubic between texels, without the four corners: five bilinear taps for sixteen
// (Jimenez, "Filmic SMAA", SIGGRAPH 2016).
vec3 sharp_history(vec2 at, vec2 size) {
  vec2 middle = floor(at - 0.5) + 0.5;
  vec2 f = at - middle;
  vec2 w0 = f * (-0.5 + f * (1.0 - 0.5 * f));
  vec2 w1 = 1.0 + f * f * (-2.5 + 1.5 * f);
  vec2 w2 = f * (0.5 + f * (2.0 - 1.5 * f));
  vec2 w3 = f * f * (-0.5 + 0.5 * f);
  vec2 w12 = w1 + w2;
  vec2 low = (middle - 1.0) / size;
  vec2 mid = (middle + w2 / w12) / size;
  vec2 high = (middle + 2.0) / size;
  vec4 sum = vec4(textureLod(history, mid, 0.0).rgb, 1.0) * (w12.x * w12.y);
  sum += vec4(textureLod(history, vec2(low.x, mid.y), 0.0).rgb, 1.0) * (w0.x * w12.y);
  sum += vec4(textureLod(history, vec2(high.x, mid.y), 0.0).rgb, 1.0) * (w3.x * w12.y);
  sum += vec4(textureLod(history, vec2(mid.x, low.y), 0.0).rgb, 1.0) * (w12.x * w0.y);
  sum += vec4(textureLod(history, vec2(mid.x, high.y), 0.0).rgb, 1.0) * (w12.x * w3.y);
  return max(sum.rgb / sum.a, 0.0);
}

// Held to what is new around: their mean and `width` times their spread, to each side. Beside it,
// how far that was moved: 1 for what is not to be seen any more.
vec4 held_to_new(vec3 before, ivec2 middle, ivec2 last_cell, float width) {
  vec3 sum = vec3(0.0);
  vec3 squares = vec3(0.0);
  for (int j = -1; j <= 1; ++j)
    for (int i = -1; i <= 1; ++i) {
      vec3 c = texelFetch(new_picture, clamp(middle + ivec2(i, j), ivec2(0), last_cell), 0).rgb;
      c = 1.0 - exp(-c);
      sum += c;
      squares += c * c;
    }
  vec3 mean = sum / 9.0;
  vec3 spread = width * sqrt(max(squares / 9.0 - mean * mean, 0.0));
  vec3 shown = 1.0 - exp(-before);
  vec3 held = clamp(shown, mean - spread, mean + spread);
  vec3 moved = abs(held - shown);
  float doubt = clamp(6.0 * max(moved.r, max(moved.g, moved.b)) - 0.1, 0.0, 1.0);
  return vec4(-log(1.0 - clamp(held, 0.0, 0.99999)), doubt);
}

vec4 resolved_picture(vec2 pixel, vec2 resolution, float time) {
  ivec2 at = ivec2(pixel);
  ivec2 last_cell = textureSize(new_picture, 0) - 1;
  ivec2 own = clamp((at - turn) / 2, ivec2(0), last_cell);
  bool is_new = all(equal(2 * own + turn, at));
  vec2 between = 0.5 * (pixel - 0.5 - vec2(turn) - shift);
  ivec2 low = ivec2(floor(between));
  vec4 near[4];
  for (int k = 0; k < 4; ++k)
    near[k] = texelFetch(new_picture, clamp(low + ivec2(k & 1, k >> 1), ivec2(0), last_cell), 0);
  vec2 f = between - vec2(low);
  vec3 around = mix(mix(near[0], near[1], f.x), mix(near[2], near[3], f.x), f.y).rgb;
  vec3 now = texelFetch(new_picture, own, 0).rgb;
  vec4 fresh = is_new ? vec4(now, 1.0) : vec4(around, 0.0);
  if (!has_history) return fresh;

  // At an edge the nearer is followed.
  float away = near[0].a;
  for (int k = 1; k < 4; ++k)
    if (abs(near[k].a) < abs(away)) away = near[k].a;
  bool stays = same_view || (still && away > 0.0);
  float last_time = texelFetch(last_view, ivec2(0, 0), 0).w;
  vec2 then = pixel;
  if (!stays)
    then = last_pixel(pixel, resolution, abs(away), away < 0.0 ? WIND_SPEED * (time - last_time) : 0.0);
  if (any(lessThan(then, vec2(0.0))) || any(greaterThanEqual(then, resolution))) return fresh;
  float samples = texelFetch(history, ivec2(then), 0).a;
  if (samples < 0.5) return fresh;
  vec3 before = stays ? texelFetch(history, at, 0).rgb : sharp_history(then, resolution);
  if (!same_view) before *= frame_exposure() / last_exposure();
  samples = min(samples, most_samples - 1.0);
  float doubt = 0.0;
  if (!still && !same_view) {
    // What flies past uncovers what was not seen.
    float width = mix(2.0, 1.0, smoothstep(1.0, 8.0, length(then - pixel)));
    vec4 held = held_to_new(before, ivec2(floor(between + 0.5)), last_cell, width);
    before = held.rgb;
    doubt = held.a;
    samples *= 1.0 - doubt;
  }
  if (!is_new) return vec4(mix(before, around, doubt), samples);
  return vec4(mix(before, now, 1.0 / (samples + 1.0)), samples + 1.0);
}

vec3 shown_landscape(vec2 pixel, vec2 resolution) {
  vec3 seen = textureLod(history, pixel / resolution, 0.0).rgb;
  return srgb_encoded(1.0 - exp(-seen)) + (pixel_noise(pixel + 17.0) - 0.5) / 255.0;
}
