#include "terrain/ridged.hpp"

namespace wold {

Description<RidgedGround> describe(const RidgedGround&) {
  return Description<RidgedGround>("ridged", "Mountains with sharp crests.")
      .include(&RidgedGround::shape)
      .add("octaves", &RidgedGround::RidgedGround::octaves, {.min = 1, .max = 24},
           "Number of frequencies; what is finer than the samples is left out.")
      .add("lacunarity", &RidgedGround::RidgedGround::lacunarity, {.min = 1.2, .max = 4},
           "Ratio of one frequency to the one before.")
      .add("hurst", &RidgedGround::RidgedGround::hurst, {.min = 0, .max = 2},
           "Smoothness H: amplitude falls as frequency to the power -H.")
      .add("offset", &RidgedGround::offset, {.min = 0.5, .max = 2},
           "Where the crests lie in the noise.")
      .add("gain", &RidgedGround::gain, {.min = 0, .max = 8},
           "How much the height of one octave roughens the next.")
      .add("smooth_ridges", &RidgedGround::smooth_ridges, {.min = 0, .max = 1},
           "Rounds the crests: |x| becomes sqrt(x² + k²).");
}

Fractal fractal_of(const RidgedGround& parameters) {
  Fractal f{.kind = FractalKind::ridged,
            .octaves = parameters.octaves,
            .lacunarity = parameters.lacunarity,
            .hurst = parameters.hurst};
  f.offset = parameters.offset;
  f.gain = parameters.gain;
  f.smooth_ridges = parameters.smooth_ridges;
  return f;
}

Heightfield ridged(const Heightfield& input, const RidgedGround& parameters,
                   const TerrainContext& context) {
  return fractal_ground(input, fractal_of(parameters), parameters.shape, context);
}

}  // namespace wold
