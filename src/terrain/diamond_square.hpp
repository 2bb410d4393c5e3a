#pragma once
// Ground from the diamond-square algorithm (Fournier, Fussell, Carpenter, "Computer rendering of
// stochastic models", CACM 1982; Miller, "The definition and rendering of terrain maps", SIGGRAPH
// 1986): (2^N + 1)² heights.
//
//   corners                     uniform in (-corner_height, corner_height)
//   then, for each of N levels:
//     diamond: centre of each square  = mean of its 4 corners         + uniform(-spread, spread)
//     square:  centre of each rhombus = mean of its 3 or 4 corners    + uniform(-spread, spread)
//     spread = spread · spread_reduction
//
// The lowest height is moved to 0. Each draw belongs to its place in the lattice, so the result
// depends on no order. The map lies over the terrain (or a square of its own) and is sampled from
// there: its detail is set by `levels`, not by the terrain's resolution. Outside it is mirrored.

#include "terrain/operator.hpp"

namespace wold {

struct DiamondSquare {
  int levels = 10;            ///< N
  float corner_height = 300;  ///< m
  float spread = 500;         ///< m
  float spread_reduction = 0.53F;
  float size = 0;  ///< m, side of the square, around the terrain's middle; 0: the whole terrain
};

Description<DiamondSquare> describe(const DiamondSquare&);

/// The map itself. The same for any number of threads.
Grid<float> diamond_square_map(const DiamondSquare& parameters, std::uint64_t seed,
                               Progress& progress);

Heightfield diamond_square(const Heightfield& input, const DiamondSquare& parameters,
                           const TerrainContext& context);

}  // namespace wold
