#pragma once
// A heightfield made from another, sample by sample.

#include "base/parallel.hpp"
#include "terrain/operator.hpp"

namespace wold {

/// The place of sample (i, j), m.
inline DVec2 place_of(const Heightfield& field, int i, int j) {
  return field.origin + field.cell * DVec2(i, j);
}

/// Fills a grid of the shape of `field` with `function(i, j)`, row by row on many threads. Can be
/// cancelled.
template <class T, class Function>
Grid<T> map_grid(const Heightfield& field, Progress& progress, const Function& function) {
  Grid<T> out(field.height.width(), field.height.height());
  parallel_for(
      0, out.height(),
      [&](int j) {
        const std::span<T> row = out.row(j);
        for (int i = 0; i < out.width(); ++i) row[static_cast<std::size_t>(i)] = function(i, j);
        progress.advance(0);  // also says that work goes on
      },
      8);
  return out;
}

/// The heights `function(height, i, j)` in the place of `input`.
template <class Function>
Heightfield map_heights(const Heightfield& input, const TerrainContext& context,
                        const Function& function) {
  return {map_grid<float>(input, context.progress,
                          [&](int i, int j) { return function(input.height(i, j), i, j); }),
          input.origin, input.cell};
}

}  // namespace wold
