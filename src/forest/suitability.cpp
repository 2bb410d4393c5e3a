#include "forest/suitability.hpp"

#include <algorithm>
#include <cmath>

#include "base/smoothstep.hpp"
#include "noise/noise.hpp"

namespace wold {

namespace {

constexpr Range any_slope{0, 90};
constexpr Range any_height{-12000, 9000};

/// 1 inside, 0 outside, soft within `softness` inside the ends that exclude something.
float inside(float x, Range range, Range any, float softness) {
  float part = 1;
  if (range.low > any.low) part *= smoothstep(range.low, range.low + softness, x);
  if (range.high < any.high) part *= smoothstep(-range.high, softness - range.high, -x);
  return part;
}

}  // namespace

Description<SuitabilitySettings> describe(const SuitabilitySettings&) {
  using S = SuitabilitySettings;
  return Description<S>("suitability", "Where plants grow.")
      .add("slope", &S::slope, {.unit = "degrees", .min = 0, .max = 90}, "Slopes it grows on.")
      .add("slope_softness", &S::slope_softness, {.unit = "degrees", .min = 0, .max = 90},
           "Over this much inside the limits of slope it thins out.")
      .add("height", &S::height, {.unit = "m", .min = -12000, .max = 9000}, "Heights it grows at.")
      .add("height_softness", &S::height_softness, {.unit = "m", .min = 0, .max = 10000},
           "Over this much inside the limits of height it thins out.")
      .add("aspect", &S::aspect, {.unit = "degrees", .min = -360, .max = 360},
           "Direction that slopes face where it grows: 0 north, 90 east.")
      .add("aspect_spread", &S::aspect_spread, {.unit = "degrees", .min = 0, .max = 180},
           "How far to either side of it; 180: everywhere.")
      .add("clumping", &S::clumping, {.min = 0, .max = 1},
           "0: everywhere alike; 1: clumps with nothing between.")
      .add("clump_size", &S::clump_size, {.unit = "m", .min = 0.01, .max = 100000},
           "From clump to clump.")
      .add("within", &S::within, {.unit = "m", .min = 0, .max = 1e6},
           "Only within this distance of the camera; 0: everywhere.")
      .add("fade", &S::fade, {.min = 0, .max = 1}, "Share of `within` over which it thins out.");
}

SuitabilityMap::SuitabilityMap(const SuitabilitySettings& settings, const Heightfield& ground,
                               const Heightfield* mask, DVec2 centre, std::uint64_t seed)
    : settings_(settings),
      ground_(ground),
      mask_(mask),
      centre_(centre),
      seed_(static_cast<std::uint32_t>(seed ^ (seed >> 32U))) {}

Suitability SuitabilityMap::at(DVec2 place) const {
  Suitability result;
  if (!ground_.contains(place)) return result;
  float part = near_centre(place);
  if (part > 0 && mask_ != nullptr) part *= std::clamp(height_at(*mask_, place), 0.0F, 1.0F);
  if (part > 0) part *= clumps(place);
  if (!(part > 0)) return result;
  result.ground = ground_at(ground_, place);
  const float slope = degrees(std::atan(glm::length(result.ground.gradient)));
  part *= inside(result.ground.height, settings_.height, any_height, settings_.height_softness) *
          inside(slope, settings_.slope, any_slope, settings_.slope_softness) *
          facing(result.ground.gradient, slope);
  result.part = part;
  return result;
}

bool SuitabilityMap::barren(DVec2 low, DVec2 high) const {
  const DVec2 ground_high = ground_.origin + ground_.size();
  if (high.x < ground_.origin.x || high.y < ground_.origin.y || low.x > ground_high.x ||
      low.y > ground_high.y)
    return true;
  if (settings_.within <= 0) return false;
  return glm::length(glm::clamp(centre_, low, high) - centre_) >
         static_cast<double>(settings_.within);
}

float SuitabilityMap::near_centre(DVec2 place) const {
  if (settings_.within <= 0) return 1;
  const auto distance = static_cast<float>(glm::length(place - centre_));
  if (distance >= settings_.within) return 0;
  return 1 - smoothstep(settings_.within * (1 - settings_.fade), settings_.within, distance);
}

float SuitabilityMap::clumps(DVec2 place) const {
  if (settings_.clumping <= 0) return 1;
  const DVec2 p = place / static_cast<double>(settings_.clump_size);
  const float noise =
      gradient_noise(p, seed_).value + 0.5F * gradient_noise(2.17 * p, seed_ + 1).value;
  return 1 - settings_.clumping * (1 - smoothstep(-0.05F, 0.25F, noise));
}

float SuitabilityMap::facing(Vec2 gradient, float slope) const {
  if (settings_.aspect_spread >= 180) return 1;
  const float azimuth = degrees(std::atan2(-gradient.x, -gradient.y));
  const float off = std::abs(std::remainder(azimuth - settings_.aspect, 360.0F));
  const float soft = 0.25F * settings_.aspect_spread;
  const float faces = 1 - smoothstep(settings_.aspect_spread - soft, settings_.aspect_spread, off);
  constexpr float flat = 3;  // degrees: level ground faces everywhere
  return 1 - smoothstep(0, flat, slope) * (1 - faces);
}

}  // namespace wold
