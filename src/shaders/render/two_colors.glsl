// Twin of TwoColorTexture (render/material.hpp): two colours mixed by a noise in space.

// `n` is fBm of gradient noise about [-1, 1].
vec3 mix_two_colors(vec3 color1, vec3 color2, float contrast, float n) {
  return mix(color1, color2, clamp(0.5 + contrast * n, 0.0, 1.0));
}
