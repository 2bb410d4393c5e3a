#pragma once
// Arithmetic on heights, sample by sample.
//
//   scale         h · factor + offset
//   remap         from[0] goes to to[0], from[1] to to[1], linearly
//   clamp         min(max(h, low), high), rounded off over `softness`
//   smooth_floor  the larger of h and level, rounded off: valley floors, frozen lakes
//   power         low + (high - low) t^exponent, t = (h - low) / (high - low); mirrored below low

#include "terrain/operator.hpp"

namespace wold {

struct Scale {
  float factor = 1;
  float offset = 0;  ///< m
};
struct Remap {
  Range from{0, 1000};  ///< m
  Vec2 to{0, 1000};     ///< m; may be turned over
};
struct Clamp {
  Range range{0, 1000};  ///< m
  float softness = 0;    ///< m
};
struct SmoothFloor {
  float level = 0;      ///< m
  float softness = 50;  ///< m
};
struct Power {
  Range range{0, 1000};  ///< m
  float exponent = 1.5F;
};

Description<Scale> describe(const Scale&);
Description<Remap> describe(const Remap&);
Description<Clamp> describe(const Clamp&);
Description<SmoothFloor> describe(const SmoothFloor&);
Description<Power> describe(const Power&);

Heightfield scale(const Heightfield& input, const Scale& parameters, const TerrainContext& context);
Heightfield remap(const Heightfield& input, const Remap& parameters, const TerrainContext& context);
Heightfield clamp_heights(const Heightfield& input, const Clamp& parameters,
                          const TerrainContext& context);
Heightfield smooth_floor(const Heightfield& input, const SmoothFloor& parameters,
                         const TerrainContext& context);
Heightfield power(const Heightfield& input, const Power& parameters, const TerrainContext& context);

}  // namespace wold
