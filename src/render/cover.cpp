#include "render/cover.hpp"

#include <algorithm>

#include "base/smoothstep.hpp"

namespace wold {

Description<GroundCover> describe(const GroundCover&) {
  using C = GroundCover;
  const Limits color{.min = 0, .max = 1};
  return Description<C>("cover", "What lies on the ground where a map says so.")
      .add("map", &C::map, "A map of a terrain step, such as rivers.water, or a picture.")
      .add("range", &C::range, {.min = -1e9, .max = 1e9}, "Values of the map where all is covered.")
      .add("feather", &C::feather, {.min = 0, .max = 1e9},
           "How far outside the range the cover fades, in the map's unit.")
      .add("edge_noise", &C::edge_noise, {.min = 0, .max = 10},
           "How far noise moves the edge, in feathers.")
      .add("color1", &C::color1, color, "Darker parts, linear Rec. 709 reflectance.")
      .add("color2", &C::color2, color, "Lighter parts.")
      .add("feature_size", &C::feature_size, {.unit = "m", .min = 0.01, .max = 1e5},
           "Size of the patches of the two colours.")
      .add("contrast", &C::contrast, {.min = 0, .max = 10}, "How sharply the two colours part.")
      .add("roughness", &C::roughness, {.min = 0, .max = 1},
           "Of a clear coat, such as water; 0 for none.")
      .add("detail", &C::detail, {.min = 0, .max = 1},
           "How much of the ground's small features shows through; 0 is smooth as water.")
      .add("opacity", &C::opacity, {.min = 0, .max = 1}, "How much of the cover is seen.")
      .add("over_snow", &C::over_snow, "Lies over the snow of [ground], too.");
}

CoverLayer::CoverLayer(const GroundCover& settings, Heightfield inner, Heightfield outer,
                       std::uint32_t seed)
    : settings_(settings),
      inner_(std::move(inner)),
      outer_(std::move(outer)),
      texture_({settings.color1, settings.color2, settings.feature_size, settings.contrast}, seed) {
}

float CoverLayer::share(DVec2 place, float noise) const {
  const Heightfield* map = nullptr;
  if (!inner_.height.empty() && inner_.contains(place))
    map = &inner_;
  else if (!outer_.height.empty() && outer_.contains(place))
    map = &outer_;
  if (map == nullptr) return 0;
  const GroundCover& c = settings_;
  const float value = height_at(*map, place) + c.edge_noise * c.feather * noise;
  const float above = smoothstep(c.range.low - c.feather, c.range.low, value);
  const float below = 1 - smoothstep(c.range.high, c.range.high + c.feather, value);
  return c.opacity * above * (value > c.range.high ? below : 1.0F);
}

}  // namespace wold
