#pragma once
// The grids, from coarse to fine, on which stream power runs.

#include <vector>

#include "base/progress.hpp"
#include "erosion/stream_power_mesh.hpp"
#include "terrain/operator.hpp"

namespace wold {

/// One grid of the ladder.
struct StreamPowerLevel {
  Heightfield ground;  ///< the input on this grid
  StreamPowerMesh mesh = {};
  double years = 0;  ///< that pass here
  int steps = 0;
};

/// From the coarsest, with 64 cells along the longer side, by halves to the input's own samples; of
/// all years the first level takes most, each further 0.4 of the one before. The coarser ones lie
/// on `domain` where the input is that with a margin, else on the lattice that goes on beyond it.
std::vector<StreamPowerLevel> stream_power_levels(const Heightfield& input,
                                                  const TerrainDomain& domain, double years,
                                                  std::uint64_t seed, Progress& progress);

/// A map of one grid over another that is at most a little coarser or any finer: bicubic, smoothed
/// where it must be.
Grid<float> regridded(const Grid<float>& map, const Heightfield& from, const Heightfield& to,
                      Progress& progress);

}  // namespace wold
