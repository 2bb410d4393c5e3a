#include "terrain/fbm.hpp"

namespace wold {

Description<FbmGround> describe(const FbmGround&) {
  return Description<FbmGround>("fbm", "Rolling ground, equally rough everywhere.")
      .include(&FbmGround::shape)
      .add("octaves", &FbmGround::FbmGround::octaves, {.min = 1, .max = 24},
           "Number of frequencies; what is finer than the samples is left out.")
      .add("lacunarity", &FbmGround::FbmGround::lacunarity, {.min = 1.2, .max = 4},
           "Ratio of one frequency to the one before.")
      .add("hurst", &FbmGround::FbmGround::hurst, {.min = 0, .max = 2},
           "Smoothness H: amplitude falls as frequency to the power -H.");
}

Fractal fractal_of(const FbmGround& parameters) {
  Fractal f{.kind = FractalKind::fbm,
            .octaves = parameters.octaves,
            .lacunarity = parameters.lacunarity,
            .hurst = parameters.hurst};
  return f;
}

Heightfield fbm(const Heightfield& input, const FbmGround& parameters,
                const TerrainContext& context) {
  return fractal_ground(input, fractal_of(parameters), parameters.shape, context);
}

}  // namespace wold
