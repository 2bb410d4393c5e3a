#pragma once
// Mountains from a ridged multifractal (noise/fractal.hpp): sharp crests, rough where they are
// high.

#include "terrain/fractal_ground.hpp"

namespace wold {

struct RidgedGround {
  FractalShape shape{.height = 900, .base = 0, .feature_size = 2500};
  int octaves = 14;
  float lacunarity = 2.03F;
  float hurst = 1;
  float offset = 1;
  float gain = 2;
  float smooth_ridges = 0.02F;
};

Description<RidgedGround> describe(const RidgedGround&);

Fractal fractal_of(const RidgedGround& parameters);

Heightfield ridged(const Heightfield& input, const RidgedGround& parameters,
                   const TerrainContext& context);

}  // namespace wold
