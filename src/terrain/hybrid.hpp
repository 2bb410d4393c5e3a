#pragma once
// Hills from a hybrid multifractal (noise/fractal.hpp): valleys are smooth, and heights are rough.

#include "terrain/fractal_ground.hpp"

namespace wold {

struct HybridGround {
  FractalShape shape{.height = 600, .base = 0, .feature_size = 2000};
  int octaves = 14;
  float lacunarity = 2.03F;
  float hurst = 0.25F;
  float offset = 0.7F;
};

Description<HybridGround> describe(const HybridGround&);

Fractal fractal_of(const HybridGround& parameters);

Heightfield hybrid(const Heightfield& input, const HybridGround& parameters,
                   const TerrainContext& context);

}  // namespace wold
