#pragma once
// Where a step acts: the mask of its settings; and maps that parameters name.

#include "terrain/steps.hpp"

namespace wold {

/// 1 inside the range and 0 outside, with soft edges of the given width; an end of the range at
/// or beyond that of `whole` is no edge.
float soft_range(const Range& range, const Range& whole, float width, float x);

/// Whether the settings mean anything but "everywhere, wholly".
bool has_mask(const StepSettings& settings);

/// A map by name over the samples of `input`: of a named step (the map that it made to be a mask,
/// its only one, or its heights), a map of any step before ("flow", "rivers.flow"), or a picture
/// laid over the whole terrain. Resampled where `input` has samples of its own. Throws Error(input)
/// for an unknown name, Error(io) for an unreadable picture.
Grid<float> map_over(const Heightfield& input, const std::string& name,
                     const TerrainContext& context);

/// opacity · (map, step or picture) · height range · slope range, over the samples of `input`.
/// Throws as `map_over`.
Grid<float> step_mask(const Heightfield& input, const StepSettings& settings,
                      const TerrainContext& context);

}  // namespace wold
