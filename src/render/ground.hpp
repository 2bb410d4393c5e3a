#pragma once
// The ground as the renderer sees it: a height for every place of the plane, in any detail, and its
// colours.
//
// Inside the scene's heightfield the height is its bicubic surface. Around it lies a coarser
// heightfield, `surroundings`, lifted near the border so that both meet without a step; beyond that
// the ground goes on at border height. Where the samples stand further apart than the features of
// soil and stone, fBm adds them (`detail`), so that ground near the camera is not smooth. Covers
// (cover.hpp) lie on it where maps say so, and water (water.hpp) stands over it.

#include <cstdint>
#include <vector>

#include "base/parameters.hpp"
#include "render/cover.hpp"
#include "render/material.hpp"
#include "render/water.hpp"
#include "terrain/heightfield.hpp"

namespace wold {

/// Colours of the ground, and where they lie (spec: rock over a height band, rock and snow by
/// slope).
struct GroundMaterial {
  Vec3 soil_color1{0.085F, 0.062F, 0.040F};
  Vec3 soil_color2{0.155F, 0.115F, 0.072F};
  Vec3 grass_color1{0.052F, 0.078F, 0.022F};
  Vec3 grass_color2{0.105F, 0.115F, 0.040F};
  Vec3 rock_color1{0.13F, 0.125F, 0.12F};
  Vec3 rock_color2{0.29F, 0.27F, 0.245F};
  Vec3 snow_color{0.80F, 0.83F, 0.88F};
  float grass_cover = 0.65F;      ///< share of the soil under grass and moss
  float patch_size = 9;           ///< m, of grass on soil
  float rock_feature_size = 45;   ///< m
  Range rock_slope{33, 46};       ///< degrees: none below, all above
  Range rock_height{3000, 4000};  ///< m: none below, all above
  Range snow_height{6000, 7000};  ///< m: none below, all above
  Range snow_slope{36, 52};       ///< degrees: all below, none above
  float distant_forest = 0.7F;    ///< share of the surroundings under trees, where trees grow
  Vec3 canopy_color1{0.016F, 0.032F, 0.011F};
  Vec3 canopy_color2{0.045F, 0.075F, 0.022F};
  float detail = 1;  ///< height of soil and stone features, relative to natural ones
};

Description<GroundMaterial> describe(const GroundMaterial&);

/// What the path tracer needs at a point of the ground.
struct GroundSurface {
  Vec3 normal{0, 0, 1};  ///< unit
  Vec3 reflectance{0};
  float roughness = 0;  ///< of a clear coat; 0 for none
};

/// What lies on the land.
struct GroundDressing {
  std::vector<CoverLayer> covers = {};  ///< over one another in their order
  WaterSettings water = {};
  WaterLayer inner_water = {};  ///< over the field
  WaterLayer outer_water = {};  ///< over the surroundings
};

/// What the surroundings' ground rises by at a place outside the field, m: as much as field and
/// surroundings differ at the nearest place of the border, less the further away.
float border_lift(const Heightfield& field, const Heightfield& surroundings, DVec2 place);

class Ground {
 public:
  /// `surroundings` may be empty.
  Ground(Heightfield field, Heightfield surroundings, GroundMaterial material, std::uint64_t seed,
         GroundDressing dressing = {});

  /// The noises and textures it is made of, for its twin in GLSL (shaders/render/ground.glsl).
  struct Noises {
    const FractalSampler& detail;  ///< small features of soil and rock
    const FractalSampler& edges;   ///< of covers
    const FractalSampler& grains;
    const FractalSampler& patches;  ///< of grass on soil
    const FractalSampler& woods;    ///< distant forest
    const FractalSampler& crowns;   ///< of its trees
    const FractalSampler& ripples;  ///< on water
    const TwoColorTexture& soil;
    const TwoColorTexture& grass;
    const TwoColorTexture& rock;
    const TwoColorTexture& canopy;
  };

  const Heightfield& field() const { return field_; }
  /// Empty where there are none.
  const Heightfield& surroundings() const { return surroundings_; }
  const GroundMaterial& material() const { return material_; }
  const GroundDressing& dressing() const { return dressing_; }
  /// Size of the largest features that detail adds, m.
  float widest_detail() const { return widest_detail_; }
  Noises noises() const {
    return {detail_,  edges_, grains_, patches_, woods_, crowns_,
            ripples_, soil_,  grass_,  rock_,    canopy_};
  }
  /// Square of ground that is modelled: the surroundings where there are any.
  DVec2 low() const { return low_; }
  DVec2 high() const { return high_; }
  Range height_range() const { return heights_; }

  /// Height of the land without detail, m, with gradient.
  GroundSample base(DVec2 place) const;
  /// Height and gradient with detail down to features of `spacing` metres: of the land, or of the
  /// water over it.
  GroundSample detailed(DVec2 place, float spacing) const;
  /// Depth of water over the land without detail, m; 0 where it is dry.
  float water_depth(DVec2 place) const;
  /// Colours and normal for a footprint of `footprint` metres.
  GroundSurface surface(DVec2 place, float footprint) const;

 private:
  struct Cover {
    float jitter = 0;  // noises about [-1, 1]
    float grain = 0;
    float rock = 0;  // shares
    float snow = 0;
    float canopy = 0;
  };
  bool inside_field(DVec2 place) const;
  float lift(DVec2 place) const { return border_lift(field_, surroundings_, place); }
  /// Share of tree crowns seen from afar: none inside the field, where plants stand themselves.
  float canopy_share(DVec2 place, float slope) const;
  GroundSample with_detail(GroundSample base, DVec2 place, float spacing) const;
  Cover cover(DVec2 place, float footprint, const GroundSample& base,
              const GroundSample& detailed) const;
  Vec3 soil_and_grass(Vec3 p, float footprint, const Cover& c) const;
  Vec3 bare_ground(Vec3 p, float footprint, const Cover& c) const;
  /// Colours and normal of the land alone.
  GroundSurface land(DVec2 place, float footprint, const GroundSample& base,
                     const GroundSample& detailed) const;
  std::optional<float> water_level(DVec2 place) const;
  Vec3 water_normal(DVec2 place, float footprint) const;
  /// Share of the small features that covers let through.
  float detail_share(DVec2 place, float edge_noise) const;

  Heightfield field_;
  Heightfield surroundings_;
  GroundMaterial material_;
  GroundDressing dressing_;
  float widest_detail_;  // m
  FractalSampler detail_;
  FractalSampler edges_;
  FractalSampler grains_;
  FractalSampler patches_;
  FractalSampler woods_;
  FractalSampler crowns_;
  FractalSampler ripples_;
  TwoColorTexture soil_;
  TwoColorTexture grass_;
  TwoColorTexture rock_;
  TwoColorTexture canopy_;
  DVec2 low_{0};
  DVec2 high_{0};
  Range heights_;
};

}  // namespace wold
