#pragma once
// What lies on the ground where a map says so: gravel in a river's bed, scree under a wall, beds of
// stone, still water.
//
// A cover's share at a place comes from its map's value v there:
//
//   1 inside `range`, falling to 0 over `feather` outside it,  its edge broken up by noise
//
// Covers lie over soil, grass and rock in the order of the scene, under the snow of height. One
// with a `roughness` has a clear coat, as water has.

#include <cstdint>

#include "base/parameters.hpp"
#include "render/material.hpp"
#include "terrain/heightfield.hpp"

namespace wold {

struct GroundCover {
  FilePath map = {};        ///< a map of a terrain step, or a picture over the terrain
  Range range{1, 1e9F};     ///< of the map's values: wholly covered
  float feather = 1;        ///< in the map's unit, outside the range
  float edge_noise = 0.3F;  ///< how far noise moves the edge, in feathers
  Vec3 color1{0.18F, 0.17F, 0.15F};
  Vec3 color2{0.30F, 0.28F, 0.25F};
  float feature_size = 3;  ///< m
  float contrast = 1;
  float roughness = 0;  ///< of a clear coat; 0 for none
  float detail = 1;     ///< share of the ground's small features that shows through; 0: smooth
  float opacity = 1;
  bool over_snow = false;
};

Description<GroundCover> describe(const GroundCover&);

/// A cover ready to be looked up. Outside both maps it is nowhere.
class CoverLayer {
 public:
  /// `inner` is the map over the terrain, `outer` over the surroundings; either may be empty.
  CoverLayer(const GroundCover& settings, Heightfield inner, Heightfield outer, std::uint32_t seed);

  const GroundCover& settings() const { return settings_; }
  /// From 0 to 1; `noise` about [-1, 1] breaks up the edge.
  float share(DVec2 place, float noise) const;
  Vec3 color(Vec3 p, float footprint) const { return texture_.at(p, footprint); }

  const Heightfield& inner() const { return inner_; }
  const Heightfield& outer() const { return outer_; }
  const TwoColorTexture& texture() const { return texture_; }

 private:
  GroundCover settings_;
  Heightfield inner_;
  Heightfield outer_;
  TwoColorTexture texture_;
};

}  // namespace wold
