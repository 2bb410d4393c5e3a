#pragma once
// The steps of dissolution over one row. Symbols as in dissolution.hpp.

#include "erosion/pipes_rows.hpp"

namespace wold::dissolution_detail {

using pipes_detail::Grains;

/// Sums over cells, in grains.
struct Sums {
  std::int64_t water_in = 0;
  std::int64_t water_out = 0;
  std::int64_t ground_out = 0;
  std::int64_t taken_up = 0;

  Sums& operator+=(const Sums& b);
};

/// What is the same for all cells in a step.
struct WeatherConstants {
  float rain = 0;        ///< grains
  float turn = 0;        ///< of a grain, so that what is less than one rains by turns
  float evaporated = 0;  ///< share
  Grains dry = 0;        ///< less evaporates at once
  float saturation = 0;  ///< K_s
  float dissolving = 0;  ///< share of what is lacking
  float depositing = 0;  ///< share of what is too much
  float least_drop = 0;  ///< m
};

/// A row of ground.
struct GroundRow {
  const float* ground;   ///< m, as it was at first
  const Grains* change;  ///< since
  const Grains* taken;   ///< to be taken from it
};

/// Rain, evaporation, and exchange of the water over row `at` with the ground: `taken` is what is
/// to be taken from the ground, negative where it is laid down.
struct WeatherRow {
  GroundRow below;
  GroundRow at;
  GroundRow above;
  const float* rain;  ///< factor
  const float* ease;  ///< factor of what is dissolved
  Grains* depth;
  Grains* dissolved;
  Grains* taken;
};
Sums weather(const WeatherRow& r, int n, const WeatherConstants& c);

/// The ground of row `at` without what is taken from it; that is spread a little over neighbours.
void wear(const GroundRow& below, const GroundRow& at, const GroundRow& above, Grains* change,
          int n);

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
