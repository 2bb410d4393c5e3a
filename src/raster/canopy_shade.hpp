#pragma once
// How much of the sky the crowns of trees hide from what stands below them: a map of leaf area over
// the ground.
//
// A crown of leaf area A (one side, m²) over a disc of radius r adds A / (π r²) to the leaf area
// index L of the ground under it. What of an even sky passes a canopy of index L is exp(-k L), with
// k = 0.5 for leaves that lie every way (Monsi, Saeki 1953): the shader's share for places below
// the crowns' foot, and a smaller part of L within them. Half of an even sky's light on the level
// comes from within 45 degrees of the zenith, through the crowns overhead; the rest, and the light
// of a low sun, through those that stand around: for these L is averaged over a square of 25 m.

#include <span>
#include <vector>

#include "render/world.hpp"

namespace wold {

struct CanopyShade {
  int width = 0;
  int height = 0;
  /// Four for each. Of crowns: L, and L times the height of the foot and of the top (m), so that
  /// what is looked up between two of them is right; L as the mean over what stands around.
  /// Of small plants: L, and L times the part of the light that their leaves scatter, by colour.
  std::vector<float> texels;
  Vec4 place{0};  ///< texture coordinate = zw + xy · place; all 0: no crowns
};

/// Of the world's plants of at least `least_height` metres, over its field.
CanopyShade canopy_shade(const World& world, float least_height = 3);

/// Of small plants about an eye, finely: leaf area over a square of that half-width, of models of
/// the world.
CanopyShade undergrowth_shade(const World& world, std::span<const ModelInstance> plants, DVec2 eye,
                              double half_width);

}  // namespace wold
