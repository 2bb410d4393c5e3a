#pragma once
// Maps of where drops went (droplets.hpp).

#include <cstdint>
#include <vector>

#include "base/grid.hpp"
#include "base/progress.hpp"
#include "erosion/droplet_walk.hpp"

namespace wold {

/// What drops left at each sample while they were recorded.
struct DropletRecord {
  std::vector<DropletPasses> passes;  ///< in rows `droplet_stride` apart
  double rain = 0;                    ///< drops per m² that were recorded
};

/// Area whose rain comes through, m².
Grid<float> discharge_map(const DropletRecord& record, int width, int height, Progress& progress);

/// Mean speed of what passes, m/s; 0 where nothing does.
Grid<float> velocity_map(const DropletRecord& record, int width, int height, Progress& progress);

/// Concentration of paths, 0 to 1: each metre of area per metre of width, and a tenth of a pass,
/// moves w ← w (1 - f) + f with f = 0.2 e^(-6.61 contrast). Samples darker than all around them
/// get the mean of those.
Grid<float> flow_map(const Grid<float>& discharge, double cell, float contrast, Progress& progress);

}  // namespace wold
