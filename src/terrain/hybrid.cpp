#include "terrain/hybrid.hpp"

namespace wold {

Description<HybridGround> describe(const HybridGround&) {
  return Description<HybridGround>("hybrid", "Smooth valleys between rough heights.")
      .include(&HybridGround::shape)
      .add("octaves", &HybridGround::HybridGround::octaves, {.min = 1, .max = 24},
           "Number of frequencies; what is finer than the samples is left out.")
      .add("lacunarity", &HybridGround::HybridGround::lacunarity, {.min = 1.2, .max = 4},
           "Ratio of one frequency to the one before.")
      .add("hurst", &HybridGround::HybridGround::hurst, {.min = 0, .max = 2},
           "Smoothness H: amplitude falls as frequency to the power -H.")
      .add("offset", &HybridGround::offset, {.min = 0, .max = 2},
           "Raises the noise before it is multiplied; more is rougher in the valleys.");
}

Fractal fractal_of(const HybridGround& parameters) {
  Fractal f{.kind = FractalKind::hybrid,
            .octaves = parameters.octaves,
            .lacunarity = parameters.lacunarity,
            .hurst = parameters.hurst};
  f.offset = parameters.offset;
  return f;
}

Heightfield hybrid(const Heightfield& input, const HybridGround& parameters,
                   const TerrainContext& context) {
  return fractal_ground(input, fractal_of(parameters), parameters.shape, context);
}

}  // namespace wold
