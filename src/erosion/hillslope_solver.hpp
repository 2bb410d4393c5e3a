#pragma once
// Linear diffusion of heights on a grid, of any time step.
//
//   ∂h/∂t = κ (h_xx + h_yy)
//
// One implicit step along rows, then one along columns (locally one-dimensional splitting; Marchuk,
// "Splitting and alternating direction methods", 1990):
//
//   (1 - a δ_x²) h* = h,  (1 - a δ_y²) h' = h*,  a = κ Δt / cell²
//
// Unconditionally stable, never overshoots, and conserves Σh when all borders are closed. First
// order in Δt: accurate where a step spreads less than what it smooths is wide.

#include "base/grid.hpp"
#include "base/progress.hpp"
#include "erosion/flow_routing.hpp"

namespace wold {

/// One step with a = κ Δt / cell². Heights on the sides in `held` stay, so ground passes there; it
/// does not pass the others.
void diffuse(Grid<float>& height, double a, const Sides& held, Progress& progress);
void diffuse(Grid<double>& height, double a, const Sides& held, Progress& progress);

}  // namespace wold
