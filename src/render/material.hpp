#pragma once
// What plants are made of: a colour that varies in space, and how much light passes through.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/parameters.hpp"
#include "render/bsdf.hpp"

namespace wold {

/// Two colours mixed by noise in space: mix(color1, color2, clamp(1/2 + contrast · n(p /
/// feature_size))), n being fBm of gradient noise in [-1, 1]. All colours are linear Rec. 709
/// reflectances.
struct TwoColors {
  Vec3 color1{0.2F};
  Vec3 color2{0.3F};
  float feature_size = 1;  ///< m
  float contrast = 1;
};

/// The mix at p (m), octaves finer than `footprint` (m) left out. `stretch` lengthens features
/// along z.
Vec3 two_colors(const TwoColors& c, Vec3 p, float footprint, std::uint32_t seed, float stretch = 1);

struct Material {
  std::string name;
  Vec3 color1{0.2F};
  Vec3 color2{0.3F};
  float feature_size = 0.3F;  ///< m
  float contrast = 1;
  float stretch = 1;       ///< features this much longer along the stem than across
  Vec3 transmission{0};    ///< diffuse transmittance of a thin sheet
  float roughness = 0;     ///< of the coat; 0 for none
  float variation = 0.1F;  ///< of brightness and hue, between individuals and between leaves
};

Description<Material> describe(const Material&);

/// The materials that plants in `plants/` name.
std::span<const Material> standard_materials();

/// A material's colours at a point: `p` in the model's own metres, `individual` and `leaf` number
/// what it belongs to.
struct SurfaceColor {
  Vec3 reflectance{0};
  Vec3 transmittance{0};
};
SurfaceColor surface_color(const Material& m, Vec3 p, float footprint, std::uint32_t individual,
                           std::uint32_t leaf);

}  // namespace wold
