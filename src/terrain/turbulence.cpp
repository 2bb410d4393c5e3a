#include "terrain/turbulence.hpp"

namespace wold {

Description<TurbulenceGround> describe(const TurbulenceGround&) {
  return Description<TurbulenceGround>("turbulence", "Rounded humps with creases between them.")
      .include(&TurbulenceGround::shape)
      .add("octaves", &TurbulenceGround::TurbulenceGround::octaves, {.min = 1, .max = 24},
           "Number of frequencies; what is finer than the samples is left out.")
      .add("lacunarity", &TurbulenceGround::TurbulenceGround::lacunarity, {.min = 1.2, .max = 4},
           "Ratio of one frequency to the one before.")
      .add("hurst", &TurbulenceGround::TurbulenceGround::hurst, {.min = 0, .max = 2},
           "Smoothness H: amplitude falls as frequency to the power -H.");
}

Fractal fractal_of(const TurbulenceGround& parameters) {
  Fractal f{.kind = FractalKind::turbulence,
            .octaves = parameters.octaves,
            .lacunarity = parameters.lacunarity,
            .hurst = parameters.hurst};
  return f;
}

Heightfield turbulence(const Heightfield& input, const TurbulenceGround& parameters,
                       const TerrainContext& context) {
  return fractal_ground(input, fractal_of(parameters), parameters.shape, context);
}

}  // namespace wold
