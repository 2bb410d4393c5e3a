#pragma once
// Level and tilted ground:  h(p) = height - tan(slope) · (p - middle) · downhill

#include "terrain/operator.hpp"

namespace wold {

struct Constant {
  float height = 0;  ///< m
};

Description<Constant> describe(const Constant&);

Heightfield constant(const Heightfield& input, const Constant& parameters,
                     const TerrainContext& context);

struct Plane {
  float height = 0;      ///< m, in the middle of the terrain
  float slope = 5;       ///< degrees
  float downhill = 180;  ///< degrees clockwise from north
};

Description<Plane> describe(const Plane&);

Heightfield plane(const Heightfield& input, const Plane& parameters, const TerrainContext& context);

}  // namespace wold
