#pragma once
// A grid laid over a rectangle of the world and sampled elsewhere.

#include "terrain/blur.hpp"
#include "terrain/operator.hpp"

namespace wold {

/// The grid's outermost samples lie on the border of `place`. Bicubic; where the samples of `like`
/// are coarser by 2 or more, the grid is first smoothed to their spacing, so that nothing aliases
/// and the same large shapes come out.
Grid<float> resample(const Grid<float>& source, const TerrainDomain& place, Outside outside,
                     const Heightfield& like, Progress& progress);

}  // namespace wold
