// Noise over pixels that looks even at every few of them: J. Jimenez, "Next generation post
// processing in Call of Duty: Advanced Warfare", SIGGRAPH 2014.

float interleaved_noise(vec2 pixel) {
  return fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715))));
}
