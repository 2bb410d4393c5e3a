#pragma once
// Erosion by water that runs: rain and springs, rivers and lakes, valleys and fans.
//
// The pipe model of Mei, Decaudin, Hu (2007), "Fast Hydraulic Erosion Simulation and Visualization
// on GPU", mended where it says so. Each cell has ground b, water depth d and sediment s in the
// water (as depth of ground, m); a pipe joins it to each of its 4 neighbours. With cells of l
// metres and steps of Δt seconds, surface h = b + d:
//
//   pipe        q' = (q + g Δt d_p (h_1 - h_2) / l) / (1 + Δt c |q| / d_f²)         m²/s
//   limit       K = min(1, d l / (Δt Σ q'_out)),  q = K q' of the cell that it leaves
//   water       d += Δt/l (Σ q_in - Σ q_out) + rain + springs - evaporation
//   sediment    s += Δt/l (Σ q_in s/d - Σ q_out s/d), the s/d of the cell that it leaves
//   capacity    C = K_c sin max(α, α_min) |v| min(1, d / D)                        m
//   exchange    b -= x, s += x,  x = (C - s) (1 - e^(-K Δt)),  K = K_s if C > s, else K_d
//
// d_f = max(h_1, h_2) - max(b_1, b_2) is the depth of water over the sill between two cells, d_p =
// min(d_f, pipe_depth), c the drag coefficient (shear stress over density and squared speed), v the
// mean velocity of the four pipes, α the slope of the ground, D full_depth, K_s dissolving, K_d
// depositing. |q| is that of the whole vector. A steady flow down a plane runs with v² = g d S / c.
//
// Mended slips of the paper:
// - Its pipes have a fixed section, which makes waves as fast in shallow water as in deep. Ours
//   have the section l d_f: waves run with sqrt(g d) (the scheme is then that of Bates, Horritt,
//   Fewtrell 2010, J. Hydrology 387). With friction, which governs rivers, a flow down a plane has
//   its speed and depth within 3 %.
// - Its water carries no momentum along, which a dam that breaks over dry ground without friction
//   (Ritter 1892) tells: depth at the dam 21 % too great, and a steep bore in the place of the thin
//   tongue that runs ahead. `momentum` mends it, see below.
// - It has no friction, so nothing but the length of its pipes limits speed on a slope.
// - It moves sediment by looking back along the velocity, which makes and loses material. Ours goes
//   with the water through the same pipes (first-order upwind): every grain taken is laid down
//   somewhere, or leaves with the water.
// - Its rock is alike everywhere; ours is softer and harder in spots (`unevenness`), so rivers
// wind.
// - The same capacity for a film as for a river: ours grows with depth up to `full_depth`.
// - Erosion x is at most a quarter of the drop to the lowest neighbour (and of that of the least
//   slope), so water digs no holes; every 8 steps each new change of the ground is spread a cell
//   wide, sediment strays down side slopes, and banks that were cut steeper than `bank_angle`
//   slide: no spikes, no channels one cell wide that can only run along the grid.
//
// With `momentum` a pipe keeps the speed u of its water and takes up that of the pipes around it
// with the water that comes from them (Stelling, Duinmeijer 2003, Int. J. Numer. Methods Fluids 43,
// their form that conserves momentum), d_m the mean depth of the two cells:
//
//   speed       u' = (D u + Σ_k a_k (u_k - u) + g Δt min(d_m, pipe_depth) (h_1 - h_2) / l) /
//                    (D + Δt c |q| / d_f),   D = max(d_m, Σ_k a_k)
//   taken up    a_k = Δt/l max(0, mean discharge from the pipe k to this one), of its 4 neighbours
//   pipe        q' = u' (h - max(b_1, b_2)), h of the cell that it leaves
//
// u' never leaves the range of the speeds that it comes from but by the push of the surface.
// Ritter's depths are met within 0.6 % of the lake's in the mean over 400 cells of wave, that at
// the dam within 1 %; bores (Stoker 1957) run at their speed. Without it, a river down a slope S >
// 4/9 c breaks into rolling waves, as its floods (3/2 v) outrun its waves (sqrt(g d)): ripples in
// fans. With it, as in nature, only one of S > 4 c does (3/2 v > v + sqrt(g d)). It takes a quarter
// more time a step, and up to 1.6 times as many steps; where nothing rolls, land and rivers come
// out much the same.
//
// Steps: Δt <= 0.9 l / (√2 max(sqrt(g pipe_depth), 3/2 top_speed)): neither a wave in water of
// `pipe_depth` nor a flood (which moves at 3/2 of its speed) crosses a cell in both directions in a
// step. With `momentum` a wave rides on the flood: the largest sqrt(g min(d, pipe_depth)) + |v| of
// all cells in the place of that maximum, looked up every 8 steps (with 6/5 |v|, for what it may
// gain until the next). Deeper lakes level out as slowly as if they were `pipe_depth` deep; their
// surface is flat all the same.
//
// Mass: depths and the change of the ground are counted in whole grains of 2^-21 m; what one cell
// gives is, to the grain, what its neighbour takes. So nothing is lost but in the last rounding of
// heights to float, which is handed on from sample to sample.
//
// From coarse to fine: the storm runs `duration` hours over cells of `start_cell`, then a quarter
// of that over cells half as large, and so on down to the samples of the input: broad valleys are
// cut on coarse grids, brooks on fine ones, at a cost of about twice the last. The change so far,
// water and sediment go from grid to grid with their volumes kept; the ground's own detail is never
// blurred. As the ladder is in metres, the same land comes out at any resolution.
//
// The speed of the paper's world is kept, its time is not: water that carries `capacity` as great
// as this does in hours what rivers do in ages.

#include <string>
#include <vector>

#include "terrain/operator.hpp"

namespace wold {

enum class WaterBorder { open, closed, periodic };

struct Pipes {
  float duration = 3;                 ///< h
  float rain = 40;                    ///< mm/h
  std::string rain_map;               ///< factor of the rain
  std::vector<double> spring_places;  ///< m, x and y of each
  std::vector<double> spring_rates;   ///< m³/s
  float spring_radius = 25;           ///< m
  std::string water;                  ///< map of depths at the beginning, m
  bool lakes = true;                  ///< hollows are full at the beginning
  float evaporation = 0;              ///< share of the depth per hour
  WaterBorder border = WaterBorder::open;
  float capacity = 5;        ///< K_c, s
  float full_depth = 0.05F;  ///< D, m
  float least_slope = 0.5F;  ///< α_min, degrees
  float dissolving = 0.01F;  ///< K_s, 1/s
  float depositing = 0.01F;  ///< K_d, 1/s
  float bank_angle = 38;     ///< degrees
  float stirring = 0.5F;     ///< sediment that strays down a side slope of 1, of that carried
  std::string hardness;      ///< map
  bool hardness_invert = false;
  float unevenness = 1.5F;  ///< of the rock: hardness varies by e^±this
  float drag = 0.05F;       ///< c
  bool momentum = false;    ///< whether water carries its momentum along
  float pipe_depth = 5;     ///< m
  float top_speed = 5;      ///< m/s
  float start_cell = 0;     ///< m
};

Description<Pipes> describe(const Pipes&);

/// Maps: "water" (depth at the end, m), "velocity", "velocity_x", "velocity_y" (m/s), "wetness"
/// (share of the time on the finest grid under 1 cm of water or more), "wear" and "sediment" (what
/// the ground lost or gained, m), "carried" (what was in the water at the end and has sunk where it
/// was, m). Throws Error(input) for ground, parameters, springs and maps that are not what they may
/// be, Error(limit) for water deeper than can be counted (512 m), Error(cancelled).
TerrainResult pipes(const Heightfield& input, const Pipes& parameters,
                    const TerrainContext& context);

}  // namespace wold
