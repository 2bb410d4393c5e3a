#pragma once
// Erosion by slow water that dissolves the ground: it smooths the beds of lakes and slow rivers.
//
// After Beneš and Forsbach (2002), "Visual Simulation of Hydraulic Erosion". Each cell has ground
// b, water depth d and dissolved ground s (m of ground). A step of Δt, over cells of l metres:
//
//   rain         d += K_r Δt
//   evaporation  d *= e^(-K_e Δt), and 0 below T
//   exchange     b -= x, s += x,  x = (S - s) (1 - e^(-K Δt)), S = K_s d the most that d holds,
//                K = `dissolving` if S > s, else `depositing`
//   transport    to the lower of 8 neighbours in proportion to Δh_i / distance, h = b + d:
//                Δd = min(d, (h - mean of h and of the lower ones) / 2), s with it
//
// Mended slips: the paper's step has no length, so results hang on cells and steps. Water here
// creeps with `speed`: Δt = l / speed, one cell a step; rates are per hour. The paper says nothing
// of how much water moves; half of what levels a cell with its lower neighbours never overshoots.
//
// In theirs a hollow that water has dug holds more water, which digs it deeper, without end. So x
// is at most half of the drop to the lowest neighbour (and a ten-thousandth of the cell): water
// digs no holes, and bumps of a bed go first. What is taken up or laid down is spread a cell wide,
// but never uphill: no cracks one cell wide that can only run along the grid.
//
// Every flow is computed by one expression of the cells at its ends, in whole grains (pipes.hpp),
// and used by both: mass is exact. What is still dissolved at the end sinks where it is.

#include <string>

#include "erosion/pipes.hpp"

namespace wold {

struct Dissolution {
  float duration = 96;       ///< h
  float rain = 60;           ///< K_r, mm/h
  std::string rain_map;      ///< factor of the rain
  std::string water;         ///< map of depths at the beginning, m
  float evaporation = 0.3F;  ///< K_e, 1/h
  float dry_depth = 1e-5F;   ///< T, m
  float saturation = 0.3F;   ///< K_s, m of ground per m of water
  float dissolving = 10;     ///< 1/h
  float depositing = 10;     ///< 1/h
  float speed = 0.02F;       ///< m/s
  WaterBorder border = WaterBorder::open;
  std::string hardness;  ///< map
  bool hardness_invert = false;
};

Description<Dissolution> describe(const Dissolution&);

/// Maps: "water" (m), "carried" (what was in the water at the end and has sunk, m), "wear",
/// "sediment" (m). Throws Error(input) for ground, parameters and maps that are not what they may
/// be, Error(cancelled).
TerrainResult dissolution(const Heightfield& input, const Dissolution& parameters,
                          const TerrainContext& context);

}  // namespace wold
