#pragma once
// Working values of the pipe model while a step goes over a band of rows.

#include "erosion/pipes_solver.hpp"

namespace wold::pipes_detail {

/// Rows [first, last) and the rows of working values that roll over them; two of each kind, for
/// even and odd rows.
struct PipeSolver::Band {
  Band(int first_row, int last_row, int width)
      : first(first_row),
        last(last_row),
        east(width + 1, 2),
        north(width, 2),
        share(width, 2),
        load(width, 2),
        discharge_y(width, 2),
        speed(width + 1, 1),
        water_x(width + 1, 1),
        sediment_x(width + 1, 1),
        water_y(width, 2),
        sediment_y(width, 2),
        moved(width, 1),
        outside(width, 1),
        dry(width, 1) {}

  int first;
  int last;
  GhostGrid<float> east;   ///< driven through western faces
  GhostGrid<float> north;  ///< driven through southern faces
  GhostGrid<float> share;
  GhostGrid<float> load;
  GhostGrid<float> discharge_y;
  GhostGrid<float> speed;  ///< of faces that the band beside keeps
  GhostGrid<Grains> water_x;
  GhostGrid<Grains> sediment_x;
  GhostGrid<Grains> water_y;
  GhostGrid<Grains> sediment_y;
  GhostGrid<Grains> moved;
  GhostGrid<float> outside;  ///< ground beyond an open border
  GhostGrid<Grains> dry;     ///< zeros
  FaceRow faces_y[2] = {};
  GrainSums sums;
};

}  // namespace wold::pipes_detail
