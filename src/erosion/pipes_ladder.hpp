#pragma once
// The pipe model from coarse to fine: the ladder of grids, and what one hands to the next.

#include <vector>

#include "erosion/pipes_solver.hpp"

namespace wold::pipes_detail {

/// The grids that the water runs over, coarsest first, the last with the samples of `input`;
/// heights 0. Each next one has half the cell.
std::vector<Heightfield> ladder_of(const Heightfield& input, double start_cell);

/// Seconds on rung k of the ladder.
double seconds_on(int rung, const Pipes& parameters);

/// Metres as grains that sum to `volume` (m³): the larger of the positive and the negative part is
/// scaled to fit, and what rounding leaves goes to the next sample.
Grid<Grains> to_grains(const Grid<float>& metres, double cell, double volume);
Grid<float> to_metres(const Grid<Grains>& grains);
/// m³.
double volume_of(const Grid<Grains>& grains, double cell);

/// Depth (m) of the hollows of the ground, filled until they overflow or reach the border.
/// Barnes, Lehman, Mulla (2014), "Priority-flood".
Grid<float> hollow_depth(const Heightfield& ground);

/// Change, water and sediment on a finer ground, with the same volumes as on the coarser.
struct Brought {
  Grid<Grains> change;
  Grid<Grains> depth;
  Grid<Grains> sediment;
};
Brought bring(const PipeSolver& from, const Heightfield& to, Progress& progress);

}  // namespace wold::pipes_detail
