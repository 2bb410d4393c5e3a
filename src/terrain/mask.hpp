#pragma once
// Makes a map between 0 and 1 for the masks of later steps, and for materials and scattering; the
// ground stays as it is. The map is called "mask", and by the step's name where it has one.
//
//   height     1 where the height is in a range       slope     1 where the slope is in a range
//   curvature  1 on crests or in hollows              noise     patches that cover a given part
//   picture    one channel of a picture laid over the whole terrain
//   map        a map of a step before, from 0 to 1 over a range of its values

#include "terrain/operator.hpp"

namespace wold {

enum class MaskSource { height, slope, crests, hollows, noise, picture, map };

struct Mask {
  MaskSource from = MaskSource::slope;
  Range height{300, 100000};     ///< m
  float height_feather = 60;     ///< m
  Range slope{30, 90};           ///< degrees
  float slope_feather = 10;      ///< degrees
  float curvature_radius = 300;  ///< m, radius of the sphere on which a crest is wholly one
  float feature_size = 400;      ///< m, of patches
  float coverage = 0.4F;         ///< part of the ground that patches cover
  float edge = 0.15F;            ///< softness of the edge of patches
  FilePath picture = {};
  std::string channel = {};
  std::string map = {};      ///< as `map_over` finds it
  Range map_range{0, 1};     ///< values of the map that become 0 and 1
  bool logarithmic = false;  ///< of the map's values: for areas and flow, which span magnitudes
  std::string times = {};    ///< another map, 0 to 1, that this one is multiplied by
  float smooth = 0;          ///< m
  bool invert = false;
};

Description<Mask> describe(const Mask&);

/// Throws Error(input) or Error(io) for the picture.
TerrainResult make_mask(const Heightfield& input, const Mask& parameters,
                        const TerrainContext& context);

/// Octaves of the noise of patches, and the noise above which the given part of its values lies;
/// the same at every resolution.
inline constexpr int patch_octaves = 6;
float patch_threshold(float coverage);

/// How far outside a place the input matters there, m.
double reach_of(const Mask& parameters, double cell);

}  // namespace wold
