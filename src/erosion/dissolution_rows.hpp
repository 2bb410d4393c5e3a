#pragma once
// The steps of dissolution over one row. Symbols as in dissolution.hpp.

#include "erosion/pipes_rows.hpp"

namespace wold::dissolution_detail {

using pipes_detail::Grains;

/// A row of cells with a ghost on either side.
struct WaterRow {
  const float* ground;   ///< m, as it was at first
  const Grains* change;  ///< since
  const Grains* depth;
  const Grains* dissolved;
  const float* give;  ///< grains that leave per m of drop and distance in cells
  const float* load;  ///< dissolved per depth
};

/// Fills `give` and `load` of a row from its neighbours.
void offer(const WaterRow& below, const WaterRow& at, const WaterRow& above, float* give,
           float* load, int n);

/// Depth and dissolved ground after all flows.
void flow(const WaterRow& below, const WaterRow& at, const WaterRow& above, Grains* depth,
          Grains* dissolved, int n);

/// What flows from sample i of `a` to sample k of `b`, `distance` cells away.
struct Flow {
  Grains water;
  Grains dissolved;
};
Flow flow_between(const WaterRow& a, int i, const WaterRow& b, int k, float distance);

}  // namespace wold::dissolution_detail
