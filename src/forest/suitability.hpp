#pragma once
// How well a place suits what is scattered: 0 nothing grows, 1 full density. The product of soft
// limits on slope, height and aspect, clumps of noise, a mask, and distance from a centre.

#include <cstdint>

#include "base/parameters.hpp"
#include "base/vec.hpp"
#include "terrain/heightfield.hpp"

namespace wold {

/// Limits are strict: nothing outside. Full density begins `softness` inside of them, except at an
/// end that excludes nothing (slope 0 or 90°, the ends of the height's default).
struct SuitabilitySettings {
  Range slope{0, 35};          ///< degrees
  float slope_softness = 6;    ///< degrees
  Range height{-12000, 9000};  ///< m
  float height_softness = 20;  ///< m
  float aspect = 0;            ///< degrees, from north clockwise, where the slope faces
  float aspect_spread = 180;   ///< degrees to either side
  float clumping = 0;
  float clump_size = 30;  ///< m
  float within = 0;       ///< m, 0 for everywhere
  float fade = 0.4F;      ///< share of `within`
};

Description<SuitabilitySettings> describe(const SuitabilitySettings&);

struct Suitability {
  float part = 0;  ///< of the full density
  GroundSample ground;
};

/// `mask` may be null; its values are taken as 0 to 1. `centre` is that of `within`.
class SuitabilityMap {
 public:
  SuitabilityMap(const SuitabilitySettings& settings, const Heightfield& ground,
                 const Heightfield* mask, DVec2 centre, std::uint64_t seed);

  Suitability at(DVec2 place) const;
  /// Whether `at` is 0 in the whole rectangle for sure.
  bool barren(DVec2 low, DVec2 high) const;

 private:
  float near_centre(DVec2 place) const;
  float clumps(DVec2 place) const;
  float facing(Vec2 gradient, float slope) const;

  SuitabilitySettings settings_;
  const Heightfield& ground_;
  const Heightfield* mask_;
  DVec2 centre_;
  std::uint32_t seed_;
};

}  // namespace wold
