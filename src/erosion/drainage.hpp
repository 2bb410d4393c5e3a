#pragma once
// Where water runs on given ground: depressions filled or breached, upstream areas, basins, lakes,
// rivers. Nothing is eroded.
//
// Depressions: drainage_depressions.hpp. Areas: flow_routing.hpp (D8) and drainage_area.hpp (D∞,
// multiple flow). Rivers, basins, lakes: drainage_network.hpp, along D8 directions.
//
// Maps:
//   area     A, upstream area with the sample itself, m²
//   flow     A / (A + river_area): 0.5 where a river begins, towards 1 along large rivers
//   wetness  topographic wetness index ln(a / tan β), a = A / cell in m, tan β at least 0.001
//            (Beven and Kirkby, "A physically based, variable contributing area model", 1979)
//   lakes    depth of water in depressions that are not breached, m
//   basins   1, 2, …: where the water ends
//   order    Strahler's order of rivers, 0 elsewhere
//
// With `none` water ends in the pits of the ground as it is.

#include "terrain/operator.hpp"

namespace wold {

enum class DepressionMethod { fill, breach, none };
enum class FlowMethod { d8, d_infinity, multiple };

struct Drainage {
  DepressionMethod depressions = DepressionMethod::breach;
  FlowMethod flow = FlowMethod::multiple;
  float exponent = 1.1F;      ///< of multiple flow
  float river_area = 50000;   ///< m², upstream area from which there is a river
  float breach_depth = 10;    ///< m
  float breach_length = 500;  ///< m
  bool change_ground = true;
};

Description<Drainage> describe(const Drainage&);

/// Throws as check_erosion.
TerrainResult drainage(const Heightfield& input, const Drainage& parameters,
                       const TerrainContext& context);

}  // namespace wold
