#pragma once
// Steps in the ground, as hard layers of rock leave them:
//
//   x = (h + variation · n(p)) / spacing,  k = floor(x),  f = x - k
//   h' = mix(h, spacing · (k + smoothstep((f - flat) / (1 - flat))) - variation · n(p), strength)
//
// The lower part `flat` of each layer becomes level, and the rest a rise to the next.

#include "terrain/operator.hpp"

namespace wold {

struct Terrace {
  float spacing = 60;        ///< m, height of a step
  float flat = 0.5F;         ///< part of each layer that is level
  float strength = 0.7F;     ///< 0: nothing happens
  float variation = 40;      ///< m, how far the layers bend up and down
  float feature_size = 900;  ///< m, size of the bends
};

Description<Terrace> describe(const Terrace&);

Heightfield terrace(const Heightfield& input, const Terrace& parameters,
                    const TerrainContext& context);

}  // namespace wold
