#pragma once
// Still and running water on the ground: a surface at the level that a map of depths gives.
//
// Where the map has water, level = bed + depth. A few samples beyond, the level goes on, so that
// the shore lies where the ground itself, with all its detail, comes out of the water, and not on
// the border of samples; ground that lies lower than the level and is dry by the map stays dry.
//
// The water's body is a colour, through which the bed shows as far as `clarity` lets it (Beer and
// Lambert along the way down and up); its surface is a clear coat with small waves.

#include <optional>

#include "base/parameters.hpp"
#include "terrain/heightfield.hpp"

namespace wold {

struct WaterSettings {
  FilePath depth = {};                 ///< a map in m, such as rivers.water; empty: no water
  float least_depth = 0.05F;           ///< m: thinner water only wets the ground
  Vec3 color{0.010F, 0.026F, 0.030F};  ///< of deep water, linear Rec. 709
  float clarity = 1.5F;                ///< m of depth after which 1/e of the bed shows
  float roughness = 0.05F;             ///< of the surface's reflections
  float ripples = 0.02F;               ///< slope of small waves
};

Description<WaterSettings> describe(const WaterSettings&);

/// Water over a heightfield.
class WaterLayer {
 public:
  WaterLayer() = default;
  /// `depth` (m) over the samples of `bed`.
  WaterLayer(const Heightfield& bed, const Grid<float>& depth, float least_depth);

  bool empty() const { return level_.height.empty(); }
  bool contains(DVec2 place) const { return !empty() && level_.contains(place); }
  /// Height of the water's surface, m: there is water where it lies above the ground. Nothing
  /// outside the field.
  std::optional<float> level_at(DVec2 place) const;
  /// The levels at the samples; they lie below the ground where there is no water.
  const Heightfield& levels() const { return level_; }

 private:
  Heightfield level_;  ///< below the ground where there is none
};

}  // namespace wold
