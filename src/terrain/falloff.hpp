#pragma once
// Lowers the ground towards the edge of the terrain: islands, and pictures without a cut edge.
//
//   h = mix(input, level, smoothstep of how deep in the border band the place lies)
//
// The band lies inside the terrain, `width` wide; noise makes it irregular.

#include "terrain/operator.hpp"

namespace wold {

enum class FalloffShape { round, square };

struct Falloff {
  FalloffShape shape = FalloffShape::round;
  float width = 1000;         ///< m
  float level = -50;          ///< m, height at the edge
  float irregularity = 600;   ///< m, how far noise shifts the band inwards
  float feature_size = 1500;  ///< m
};

Description<Falloff> describe(const Falloff&);

Heightfield falloff(const Heightfield& input, const Falloff& parameters,
                    const TerrainContext& context);

}  // namespace wold
