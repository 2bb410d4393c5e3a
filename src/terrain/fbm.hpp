#pragma once
// Hills from fractional Brownian motion: the sum of a_i n(f_i p) over octaves (noise/fractal.hpp).
// The same roughness everywhere.

#include "terrain/fractal_ground.hpp"

namespace wold {

struct FbmGround {
  FractalShape shape{.height = 300, .base = 0, .feature_size = 1500};
  int octaves = 14;
  float lacunarity = 2.03F;
  float hurst = 1;
};

Description<FbmGround> describe(const FbmGround&);

Fractal fractal_of(const FbmGround& parameters);

Heightfield fbm(const Heightfield& input, const FbmGround& parameters,
                const TerrainContext& context);

}  // namespace wold
