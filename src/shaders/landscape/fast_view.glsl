// What is the same for all pixels of a frame, worked out once: a row of texels.

uniform highp sampler2D frame_view;
uniform highp sampler2D last_view;

View seen_from(highp sampler2D texels) {
  vec4 place = texelFetch(texels, ivec2(0, 0), 0);
  vec3 forward = texelFetch(texels, ivec2(1, 0), 0).xyz;
  vec3 right = texelFetch(texels, ivec2(2, 0), 0).xyz;
  return View(place.xy, place.z, forward, right, cross(right, forward));
}

Light frame_light() {
  return Light(texelFetch(frame_view, ivec2(6, 0), 0).xyz,
               texelFetch(frame_view, ivec2(3, 0), 0).xyz,
               texelFetch(frame_view, ivec2(4, 0), 0).xyz);
}
float frame_exposure() {
  return texelFetch(frame_view, ivec2(3, 0), 0).w;
}
float last_exposure() {
  return texelFetch(last_view, ivec2(3, 0), 0).w;
}
// Half the longer side of what is seen at distance 1.
float last_half_width() {
  return texelFetch(last_view, ivec2(1, 0), 0).w;
}
vec3 sun_on_clouds() {
  return texelFetch(frame_view, ivec2(5, 0), 0).xyz;
}

vec4 view_texel(int k, vec2 resolution, float time) {
  View view = landscape_view(resolution, vec4(0.0), time);
  if (k == 0) return vec4(view.place, view.height, time);
  if (k == 1) return vec4(view.forward, tan(0.5 * radians(FIELD_OF_VIEW)));
  if (k == 2) return vec4(view.right, 0.0);
  vec3 sun = sun_direction(time);
  if (k == 6) return vec4(sun, 0.0);
  Light light = light_at(sun, k == 5 ? CLOUDS_HEIGHT + 0.5 * CLOUDS_THICKNESS : view.height);
  return k == 4 ? vec4(light.sky, 0.0) : vec4(light.sun, exposure_for(light));
}
