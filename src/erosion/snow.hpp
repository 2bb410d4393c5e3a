#pragma once
// Snow: falls to a depth, less below the snow line and more in the lee of the wind, and slides off
// what is steeper than it can lie on, over ground that stays as it is:
//
//   depth = D s(h) m clamp(1 - drift (grad h · w), 0, 2)
//
// h (m) the ground, s a smooth step from 0 to 1 over `feather` around the snow line, m a map, w the
// unit vector along the wind: where the ground falls along it is lee. How it slides:
// thermal_slide.hpp, without the ladder: a thin cover crosses a cell per pass, and coarser cells
// would bare the ground in blocks.

#include <string>

#include "erosion/thermal_slide.hpp"
#include "terrain/operator.hpp"

namespace wold {

struct Snow {
  float depth = 3;        ///< m
  float snow_line = 300;  ///< m
  float feather = 300;    ///< m
  float angle = 42;       ///< degrees
  std::string map;        ///< name of a map
  float wind_from = 270;  ///< degrees clockwise from north
  float drift = 0;        ///< of depth, per unit of slope
  float tolerance = .5F;  ///< degrees
  int max_passes = 300;
};

Description<Snow> describe(const Snow&);

/// The ground with its snow. Map: "snow" (its depth, m). Throws Error(input), Error(cancelled).
TerrainResult snow(const Heightfield& input, const Snow& parameters, const TerrainContext& context);

}  // namespace wold
