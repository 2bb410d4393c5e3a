#include "terrain/eroded_noise.hpp"

namespace wold {

Description<ErodedGround> describe(const ErodedGround&) {
  return Description<ErodedGround>("eroded_noise",
                                   "Ground that looks worn: smooth slopes, rough tops and bottoms.")
      .include(&ErodedGround::shape)
      .add("octaves", &ErodedGround::ErodedGround::octaves, {.min = 1, .max = 24},
           "Number of frequencies; what is finer than the samples is left out.")
      .add("lacunarity", &ErodedGround::ErodedGround::lacunarity, {.min = 1.2, .max = 4},
           "Ratio of one frequency to the one before.")
      .add("hurst", &ErodedGround::ErodedGround::hurst, {.min = 0, .max = 2},
           "Smoothness H: amplitude falls as frequency to the power -H.")
      .add("damping", &ErodedGround::damping, {.min = 0, .max = 10},
           "How much slope smooths what is finer.");
}

Fractal fractal_of(const ErodedGround& parameters) {
  Fractal f{.kind = FractalKind::eroded,
            .octaves = parameters.octaves,
            .lacunarity = parameters.lacunarity,
            .hurst = parameters.hurst};
  f.damping = parameters.damping;
  return f;
}

Heightfield eroded_noise(const Heightfield& input, const ErodedGround& parameters,
                         const TerrainContext& context) {
  return fractal_ground(input, fractal_of(parameters), parameters.shape, context);
}

}  // namespace wold
