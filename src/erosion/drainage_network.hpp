#pragma once
// What follows from the one way that water takes from each sample (flow_routing.hpp): basins, the
// channels and their order, lengths of flow; and the lakes in filled depressions.

#include <cstdint>
#include <vector>

#include "erosion/flow_routing.hpp"

namespace wold {

/// Numbers each sample by where its water ends: 1, 2, … for the outlets and pits by rows from the
/// south-west.
Grid<std::int32_t> basin_labels(const Grid<std::uint8_t>& direction, const FlowOrder& order);

/// Strahler's order of the channels, which are the samples with an upstream area of `channel_area`
/// (m²) or more; 0 elsewhere. A channel without channels upstream has order 1; where two or more of
/// the highest order o meet, o + 1 begins. (Strahler, "Quantitative analysis of watershed
/// geomorphology", 1957.)
Grid<std::uint8_t> strahler_order(const Grid<std::uint8_t>& direction, const FlowOrder& order,
                                  const Grid<double>& area, double channel_area);

/// Length of the way to where the water ends, m.
Grid<float> downstream_length(const Grid<std::uint8_t>& direction, const FlowOrder& order,
                              double cell);

/// Length of the longest way that leads to a sample, m: Hack's length.
Grid<float> upstream_length(const Grid<std::uint8_t>& direction, const FlowOrder& order,
                            double cell);

/// A lake in a filled depression.
struct Lake {
  float level = 0;    ///< m
  double area = 0;    ///< m²
  double volume = 0;  ///< m³
  float depth = 0;    ///< m, at the deepest
};

struct Lakes {
  std::vector<Lake> lakes;   ///< by their first sample, by rows from the south-west
  Grid<std::int32_t> label;  ///< 1, 2, … in the order of `lakes`; 0 on land
};

/// The connected (8 neighbours) parts of one level where `filled` (FillSurface::level) is above
/// `height`.
Lakes find_lakes(const Grid<float>& height, const Grid<float>& filled, double cell);

}  // namespace wold
