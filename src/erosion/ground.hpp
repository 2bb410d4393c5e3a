#pragma once
// What every erosion asks of the ground it is given, and the sums it answers for.

#include "terrain/operator.hpp"

namespace wold {

/// Throws Error(input) that names the first sample whose height is not a finite number, or the size
/// if there are fewer than 2 x 2 samples, or a cell that is not above 0.
void check_ground(const Heightfield& input, const std::string& op);

/// The same, and that every parameter is in its range.
template <class T>
void check_erosion(const Heightfield& input, const T& parameters) {
  const ParameterSet set = describe(parameters);
  set.check(&parameters);
  check_ground(input, set.name);
}

/// Σ value · cell², m³ for a grid in metres. In double, row by row: the same bits for any number of
/// threads.
double volume(const Grid<float>& grid, double cell);

/// The named map over the samples of `input` with values from 0 to 1, or `otherwise` everywhere
/// where the name is empty. Throws Error(input) for a map that holds values that are not finite.
Grid<float> factor_map(const Heightfield& input, const std::string& name, float otherwise,
                       const TerrainContext& context);

}  // namespace wold
