#pragma once
// Ground that looks worn: fBm whose octaves are damped where the slope gathered so far is steep
// (Quilez, "value noise derivatives", 2008; noise/fractal.hpp).

#include "terrain/fractal_ground.hpp"

namespace wold {

struct ErodedGround {
  FractalShape shape{.height = 600, .base = 0, .feature_size = 2000};
  int octaves = 14;
  float lacunarity = 2.03F;
  float hurst = 0.9F;
  float damping = 1;
};

Description<ErodedGround> describe(const ErodedGround&);

Fractal fractal_of(const ErodedGround& parameters);

Heightfield eroded_noise(const Heightfield& input, const ErodedGround& parameters,
                         const TerrainContext& context);

}  // namespace wold
