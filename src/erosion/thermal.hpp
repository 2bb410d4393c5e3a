#pragma once
// Thermal erosion: frost and gravity bring down what is too steep. Rock steeper than `cliff_angle`
// breaks; what fell is loose and slides until it lies at its angle of repose, `talus_angle`: cliffs
// with fans of scree at their feet. The law of sliding, its scheme and its source are in
// thermal_slide.hpp.
//
// With `cliff_angle` at or below `talus_angle` all ground is loose: sand. With 90 rock never breaks
// and only `loose_depth` moves.
//
// It either goes on until all rests, whatever the resolution, or for `years`, as the diffusion of
// too steep slopes with the diffusivity `rate`. Until all rests: then no sample that holds loose
// material is steeper towards any of its eight neighbours than `talus_angle` and the `tolerance`,
// whatever the ground and however few the passes (thermal_rest.hpp); the gradient, which neighbours
// along the grid show less of, is a degree or two steeper here and there. Rock above `cliff_angle`
// may stand where `max_passes` ended its breaking.

#include <string>

#include "erosion/thermal_slide.hpp"
#include "terrain/operator.hpp"

namespace wold {

struct Thermal {
  float talus_angle = 33;  ///< degrees
  float cliff_angle = 50;  ///< degrees
  float loose_depth = 0;   ///< m
  std::string hardness;    ///< name of a map
  bool hardness_invert = false;
  SlideNeighbours neighbours = SlideNeighbours::alternating;
  float tolerance = .5F;  ///< degrees
  float years = 0;        ///< 0: until all rests
  float rate = 1;         ///< m²/year
  bool ladder = true;
  int max_passes = 300;
};

Description<Thermal> describe(const Thermal&);

/// Maps: "wear" (m of rock that broke; of sand: by how much the ground sank), "sediment" (m of
/// loose material that lies; of sand: by how much the ground rose). Throws Error(input),
/// Error(cancelled).
TerrainResult thermal(const Heightfield& input, const Thermal& parameters,
                      const TerrainContext& context);

}  // namespace wold
