#pragma once
// What can be known about a list of steps before it runs.

#include "terrain/steps.hpp"

namespace wold {

/// How many samples beyond the window are needed on each side.
int margin_of(const TerrainWindow& window, std::span<const TerrainStep> steps,
              std::span<const TerrainOperator> operators);

/// Bytes at the peak of the evaluation, about.
double memory_estimate(const TerrainWindow& window, std::span<const TerrainStep> steps,
                       std::span<const TerrainOperator> operators);

}  // namespace wold
