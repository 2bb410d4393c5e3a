#pragma once
// A step that works on samples of its own distance (StepSettings::cell).

#include "terrain/operator.hpp"

namespace wold {

/// A field of samples about `cell` apart with the same corners as `like`, at height 0.
Heightfield field_with_cell(const Heightfield& like, double cell);

/// Runs the operator on `input` brought to samples about `cell` metres apart, and adds what it
/// changed, brought back, to `input`; maps are brought back as well. With a cell of 0, or for
/// operators that make ground, it simply runs. Throws what the operator throws, and Error(limit)
/// for more samples than fit in memory.
TerrainResult run_at_cell(const TerrainOperator& op, const Heightfield& input,
                          const Described& parameters, double cell, const TerrainContext& context);

}  // namespace wold
