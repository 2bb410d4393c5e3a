// To the screen: exposure, tone map, sRGB, and noise of half a step of eight bits.
#include "image/tonemap.glsl"
#include "raster/interleaved_noise.glsl"

uniform sampler2D picture;
uniform float exposure;  // factor
uniform int tone_map;

in vec2 screen_place;
out vec4 result;

void main() {
  vec3 light = texture(picture, screen_place).rgb * exposure;
  vec3 shown = srgb_encoded(tone_mapped(light, tone_map));
  result = vec4(shown + (interleaved_noise(gl_FragCoord.xy) - 0.5) / 255.0, 1.0);
}
