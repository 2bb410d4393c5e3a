#pragma once
// Material that slides until no slope is steeper than it bears: what `thermal` and `snow` share.
//
// The surface h (m) obeys
//
//   dh/dt = div(K φ grad h),     φ = (g² - T²) / (g² + T²) where g > R, else 0,     g = |grad h|
//
// R = tan(angle of repose): no steeper slope stays. T = tan(angle of repose - two tolerances) is
// where what moves would come to rest: a little less than R, so that everything rests after a
// finite time and slopes end between T and R. Beneath, φ does not depend on the direction of the
// slope, only on its steepness: cones are round, which rules that compare a cell with single
// neighbours cannot make (squares with four, octagons with eight).
//
// Two kinds of passes over the grid, by turns:
// - between the four neighbours; the slope at a face is the difference across it and the mean of
//   the four differences along it;
// - between the four diagonal neighbours (distance √2); the slope is that of the square of four
//   samples, from its two diagonals (Roberts' cross).
// Neither leaves out a pattern that both would leave out, and at rest no slope to any of the eight
// neighbours exceeds R.
//
// Loose material over a bed of rock: a cell offers no more than it holds, and its offers are
// scaled down to that; rock itself gives way above its own, steeper angle and is loose from then
// on. Each transfer is worked out once per pair of cells from the same two statements and taken
// from the one what the other is given (two phases, after B. Jákó and B. Tóth, "Fast hydraulic and
// thermal erosion on GPU", Eurographics 2011 short papers). Heights are whole numbers of a small
// unit: nothing is lost to rounding, and no order of adding matters.
//
// Stable for K Δt / cell² ≤ 0.2 (the derivative of φ g is at most 1.25): the step of the passes.
//
// Far transport is fast by a ladder: after a few passes the means of 2 x 2 cells slide first, and
// theirs before them; their changes are laid smoothly over the finer ground, which then slides
// itself. The foot of a slope is wider by about one cell of the coarsest rung that moved it.
//
// At rest is what no longer moves; and what moves only in films thinner than 2 % of a cell, or on
// slopes that exceed R by less than the tolerance. Gullies and long slopes near R stay on the move
// for thousands of passes: thermal_rest.hpp ends that.
//
// Where nothing moved in and around a tile of the grid, nothing will: it is left out of the next
// pass.

#include <cstdint>

#include "base/grid.hpp"
#include "base/progress.hpp"

namespace wold {

/// Between which cells material slides.
enum class SlideNeighbours { four, diagonals, alternating };

struct SlideRules {
  double repose = 33;     ///< degrees, of what is loose
  double cliff = 90;      ///< degrees, above which rock breaks; 90: never
  double tolerance = .5;  ///< degrees
  SlideNeighbours neighbours = SlideNeighbours::alternating;
};

/// Heights in whole units from some base.
struct SlideGround {
  Grid<std::int32_t> surface;
  Grid<std::int32_t> bed;  ///< top of the rock; empty: all is loose
  Grid<float> hardness;    ///< 0 to 1: raises the angle of rock (or of all that is loose) to 90
                           ///< degrees; empty: 0
  double unit = 1;         ///< m
  double cell = 1;         ///< m
};

/// Units that a height may have, from 0: sums of four in 32 bits.
inline constexpr std::int32_t slide_range = 1 << 28;

struct SlideLimit {
  double spread = 0;  ///< K t, m²: for so long; 0: until all rests
  int passes = 0;     ///< at most, over the ground itself, if above 0; more over coarser rungs
};

struct SlideWork {
  double cell_passes = 0;  ///< cells that passes went over, all rungs
  int passes = 0;          ///< over the ground itself
  bool at_rest = false;
};

/// Lets the ground slide. `with_ladder` only without a `spread`. Throws Error(cancelled).
SlideWork slide(SlideGround& ground, const SlideRules& rules, const SlideLimit& limit,
                bool with_ladder, Progress& progress);

/// The largest slope between any two of eight neighbours, degrees.
double steepest_step(const Grid<float>& height, double cell);

}  // namespace wold
