#pragma once
// Billowing ground from turbulence, the sum of a_i |n(f_i p)| (noise/fractal.hpp): rounded humps
// with creases between them.

#include "terrain/fractal_ground.hpp"

namespace wold {

struct TurbulenceGround {
  FractalShape shape{.height = 250, .base = 0, .feature_size = 1200};
  int octaves = 14;
  float lacunarity = 2.03F;
  float hurst = 1;
};

Description<TurbulenceGround> describe(const TurbulenceGround&);

Fractal fractal_of(const TurbulenceGround& parameters);

Heightfield turbulence(const Heightfield& input, const TurbulenceGround& parameters,
                       const TerrainContext& context);

}  // namespace wold
