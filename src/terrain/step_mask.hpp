#pragma once
// Where a step acts: the mask of its settings.

#include "terrain/steps.hpp"

namespace wold {

/// 1 inside the range and 0 outside, with soft edges of the given width; an end of the range at
/// or beyond that of `whole` is no edge.
float soft_range(const Range& range, const Range& whole, float width, float x);

/// Whether the settings mean anything but "everywhere, wholly".
bool has_mask(const StepSettings& settings);

/// opacity · (map, step or picture) · height range · slope range, over the samples of `input`.
/// `maps` are those of the steps before, by name. Throws Error(input) for an unknown name.
Grid<float> step_mask(const Heightfield& input, const StepSettings& settings,
                      const std::map<std::string, Grid<float>>& maps,
                      const TerrainContext& context);

}  // namespace wold
