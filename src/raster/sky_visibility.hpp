#pragma once
// How much of the sky the land around hides: what makes valleys darker than crests.
//
// V is the share of the sky's light that reaches a place past the land around, out of what its
// slope would see on a plane of that slope: an endless even slope has 1. With the horizon at
// elevation b in the direction φ and normal n = (n_φ, n_z) in its plane,
//
//   I(b) = n_z cos² b / 2 + n_φ (π/2 - b - sin(2b) / 2) / 2,   V = Σ I(b) / Σ I(b_0)
//
// over 16 directions, where b_0 is the slope's own horizon (N. Max, "Horizon mapping: shadows for
// bump-mapped surfaces", The Visual Computer 4, 1988, has horizons by direction). They are looked
// for at distances that grow by a quarter, in ever coarser heights.

#include "raster/sun_shadow_map.hpp"

namespace wold {

class SkyVisibility {
 public:
  explicit SkyVisibility(const Ground& ground, int most_samples = 193);

  float share(DVec2 place) const;
  /// Shares as heightfields of V.
  const Heightfield& field() const { return field_; }
  const Heightfield& around() const { return around_; }

 private:
  Heightfield field_;
  Heightfield around_;
};

}  // namespace wold
