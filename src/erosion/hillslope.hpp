#pragma once
// Hillslopes rounded by creeping soil.
//
//   ∂h/∂t = ∇·(κ_S ∇h),  κ_S = κ                                  linear
//                        κ_S = κ / (1 - (|∇h| / S_c)²)             with a critical slope S_c
//
// h height (m), t time (years), κ diffusivity of soil (m²/yr; 0.001 in deserts, 0.01 and more under
// wet forest). Linear, a Gaussian of variance σ² stays one, of variance σ² + 2 κ t. With a critical
// slope, soil runs off as slopes near it: convex tops, straight sides (Roering, Kirchner, Dietrich,
// "Evidence for nonlinear, diffusive sediment transport on hillslopes and implications for
// landscape morphology", 1999).
//
// Linear: implicit steps (hillslope_solver.hpp) of κ Δt <= 0.5 cell², up to 400 of them. With a
// critical slope: explicit steps of fluxes through the sides of cells, κ_S Δt <= 0.2 cell² for the
// largest κ_S (stable up to 0.25); (|∇h| / S_c)² is held at 0.95.
//
// Through a closed border nothing passes. Along an open one heights stay, and ground passes.
// Map: change (m), above 0 where ground came to lie.

#include "terrain/operator.hpp"

namespace wold {

enum class HillslopeBorder { closed, open };

struct Hillslope {
  float years = 10'000;
  float diffusivity = 0.005F;  ///< κ, m²/yr
  float critical_slope = 0;    ///< degrees; 0: linear
  HillslopeBorder border = HillslopeBorder::closed;
};

Description<Hillslope> describe(const Hillslope&);

/// Throws as check_erosion.
TerrainResult hillslope(const Heightfield& input, const Hillslope& parameters,
                        const TerrainContext& context);

/// How far (m) a place is felt: six standard deviations of its spreading.
double reach_of(const Hillslope& parameters, double cell);

}  // namespace wold
