#pragma once
// Mountains by uplift and running water: the stream-power law with uplift, hillslope diffusion and
// a talus angle.
//
//   ∂h/∂t = U - K A^m S^n + G q_s / A + κ ∇²h,  S at most tan(talus)
//
// h height (m), t time (years), U uplift (m/yr), A upstream area (m²), S slope along the water's
// way, K erodibility (m^(1-2m)/yr), κ diffusivity of soil on hillslopes (m²/yr), q_s flow
// of sediment (m³/yr), G how readily it settles. Where uplift and
// erosion balance, rivers have S = ((1 + G) U/K)^(1/n) A^(-m/n): concavity m/n. (Howard, "A
// detachment- limited model of drainage basin evolution", 1994; Whipple and Tucker, 1999.)
//
// Water leaves over the open sides. A sample there that has no lower neighbour is an outlet: it
// keeps its height, against which everything upstream settles.
//
// Coarse to fine: most years pass on a grid of 64 cells along the longer side of the terrain
// whatever the resolution, then the change of the ground is laid (bicubic) over the input on a grid
// twice as fine, 0.4 times as many years pass there, and so on to the ground's own samples: so
// valleys lie where they lie at every resolution, and whole ranges take seconds. Which way a river
// turns hangs on little: so the coarser grids lie on the terrain, not on the window that is
// computed, and see its ground smoothed. Each grid takes a fixed number of implicit steps
// (stream_power_solver.hpp): 40 the first, 16 each further, 32 the last.
//
// Rock: erodibility and talus angle vary by `variation` as a fractal of the place with features of
// `variation_size`, and with the map `hardness`.
//
// Maps: area (m²), flow (A / (A + river_area)), sediment (what streams laid down and still lies,
// m), wear (rock that is gone: input + uplift - output + sediment, m), uplift (m). What streams
// carry leaves the map: removed = Σ (input + uplift - output).

#include "terrain/operator.hpp"

namespace wold {

enum class OpenSides { all, west, east, south, north, west_east, south_north };

struct StreamPower {
  float years = 300'000;
  float uplift = 1;             ///< mm/yr
  std::string uplift_map = {};  ///< 0 to 1, times uplift
  float erodibility = 1e-5F;    ///< K, m^(1-2m)/yr
  std::string hardness = {};    ///< 0 to 1: K is times 1 - hardness
  std::string rain = {};        ///< 0 to 1, relative to the rain that K is for
  float area_exponent = 0.45F;  ///< m
  float slope_exponent = 1;     ///< n
  float deposition = 0.5F;      ///< G
  float diffusivity = 0.002F;   ///< κ, m²/yr
  float talus = 35;             ///< degrees
  float variation = 0.4F;       ///< of rock, 0 to 1
  float variation_size = 400;   ///< m
  OpenSides open = OpenSides::all;
  float river_area = 50000;  ///< m², for the map flow
};

Description<StreamPower> describe(const StreamPower&);

/// Throws as check_erosion.
TerrainResult stream_power(const Heightfield& input, const StreamPower& parameters,
                           const TerrainContext& context);

}  // namespace wold
