#pragma once
// Ground from a fractal: what the fractal operators share.
//
//   ground(p) = base + height · (f(p / feature_size) + lost - low) / (high - low)
//
// where low and high are the values that 0.5 % and 99.5 % of the fractal lie below, found from
// samples that depend on the fractal's parameters alone: so `height` means the same, from valleys
// to summits, whatever the octaves or the roughness, at every resolution, in every window. `lost`
// is the mean of the octaves that the samples are too coarse for (those of ridged and turbulent
// fractals have one): without it coarser ground would lie lower.

#include <vector>

#include "noise/fractal.hpp"
#include "terrain/operator.hpp"

namespace wold {

struct FractalShape {
  float height = 500;         ///< m, from valleys to summits
  float base = 0;             ///< m, height of the valleys
  float feature_size = 1500;  ///< m, distance of the largest hills
};

Description<FractalShape> describe(const FractalShape&);

struct FractalStatistics {
  Range range;          ///< what most of the values (99 %) lie between, all octaves present
  float lost_mean = 0;  ///< what the octaves that fade out at `spacing` add on average
};

FractalStatistics fractal_statistics(const Fractal& f, float spacing);

/// What each octave adds on average: an octave that fades out takes so much with it.
std::vector<float> octave_means(const Fractal& f);

/// The seed of a step's fractal.
std::uint32_t fractal_seed(std::uint64_t seed);

/// Where a step's pattern lies: lattice coordinates of the world's origin, random because gradient
/// noise is 0 at lattice points (a ridged fractal has a crest there).
DVec2 fractal_offset(std::uint64_t seed);

Heightfield fractal_ground(const Heightfield& input, const Fractal& f, const FractalShape& shape,
                           const TerrainContext& context);

/// Noise about [-1, 1], for operators that want something irregular: gradient fBm.
Grid<float> irregular(const Heightfield& input, float feature_size, int octaves, std::uint64_t seed,
                      Progress& progress);

}  // namespace wold
