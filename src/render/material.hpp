#pragma once
// What plants are made of: a colour that varies in space, and how much light passes through.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/parameters.hpp"
#include "noise/fractal.hpp"
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

/// Two colours ready to be looked up. `stretch` lengthens features along z.
class TwoColorTexture {
 public:
  TwoColorTexture(const TwoColors& colors, std::uint32_t seed, float stretch = 1);

  /// The mix at p (m); octaves finer than `footprint` (m) are left out.
  Vec3 at(Vec3 p, float footprint) const;

  const TwoColors& colors() const { return colors_; }
  float stretch() const { return stretch_; }
  const FractalSampler& noise() const { return noise_; }

 private:
  TwoColors colors_;
  float stretch_;
  FractalSampler noise_;
};

struct Material {
  std::string name;
  Vec3 color1{0.2F};
  Vec3 color2{0.3F};
  float feature_size = 0.3F;  ///< m
  float contrast = 1;
  float stretch = 1;       ///< features this much longer along the stem than across
  Vec3 transmission{0};    ///< diffuse transmittance of a thin sheet
  float roughness = 0;     ///< of the coat; 0 for none
  float variation = 0.1F;  ///< of brightness and hue, between leaves
};

Description<Material> describe(const Material&);

/// The materials that plants in `plants/` name.
std::span<const Material> standard_materials();

/// Colours at a point of a surface.
struct SurfaceColor {
  Vec3 reflectance{0};
  Vec3 transmittance{0};
};

/// A material ready to be looked up.
class SurfaceMaterial {
 public:
  /// `tint` is the difference between individuals, as `variation` is that between leaves.
  explicit SurfaceMaterial(const Material& material, float tint = 0);

  float roughness() const { return material_.roughness; }
  float tint_amount() const { return tint_; }
  const Material& settings() const { return material_; }
  /// `p` in the model's own metres; `individual` and `leaf` number what the point belongs to.
  SurfaceColor at(Vec3 p, float footprint, std::uint32_t individual, std::uint32_t leaf) const;

 private:
  Material material_;
  float tint_;
  TwoColorTexture texture_;
};

}  // namespace wold
