#pragma once
// The finished land as maps that a landscape shader reads: heights, water, what lies and grows on
// the ground. All have the same samples, in rows from the south.

#include <cstdint>
#include <optional>
#include <vector>

#include "realtime/height_map.hpp"
#include "render/ground.hpp"

namespace wold {

struct LandMap {
  HeightMap heights;
  std::optional<HeightMap> water;  ///< of its surface over `heights`; below 0 where there is none
  /// Four planes, one after the other: red, green, blue (square roots of linear reflectance), share
  /// of the ground; empty without covers.
  std::vector<std::uint8_t> covers;
  std::vector<std::uint8_t> trees;  ///< share of the ground under them; empty without trees

  /// Height of the water's surface, m.
  float water_level(int i, int j) const { return heights.at(i, j) + water->at(i, j); }
};

/// Land with what lies on it; `trees` (per m², at the field's samples) may be empty.
LandMap land_map(const Heightfield& field, const GroundDressing& dressing, const Grid<float>& trees,
                 int most_samples);

}  // namespace wold
