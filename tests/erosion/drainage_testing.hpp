#pragma once
// What the tests of drainage and stream power share.

#include <initializer_list>
#include <vector>

#include "erosion/drainage_depressions.hpp"
#include "noise/fractal.hpp"
#include "testing.hpp"

namespace wold::testing_erosion {

/// Heights as one sees them on a map: the first row is the northernmost.
inline Grid<float> ground(std::initializer_list<std::vector<float>> rows) {
  Grid<float> out(static_cast<int>(rows.begin()->size()), static_cast<int>(rows.size()));
  int j = out.height();
  for (const std::vector<float>& row : rows) {
    --j;
    for (int i = 0; i < out.width(); ++i) out(i, j) = row[static_cast<std::size_t>(i)];
  }
  return out;
}

/// Rough ground full of pits.
inline Heightfield rough(int width, int height, double cell, float relief = 100,
                         double feature = 300) {
  Heightfield field{Grid<float>(width, height), {0, 0}, cell};
  Progress progress;
  fill_fractal(field.height, {.hurst = 0.8F}, {3.7, 1.2}, cell / feature, 5, progress);
  for (float& h : field.height.values()) h *= relief;
  return field;
}

/// The level to which each sample must be flooded before its water leaves.
inline Grid<float> filled_level(const Grid<float>& height) {
  Progress progress;
  return fill_depressions(height, FillSurface::level, progress);
}

}  // namespace wold::testing_erosion
