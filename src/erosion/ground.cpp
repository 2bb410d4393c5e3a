#include "erosion/ground.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "terrain/step_mask.hpp"

namespace wold {

namespace {

/// The first column that is no finite number, or the width.
int first_not_finite(std::span<const float> row) {
  const auto found =
      std::find_if(row.begin(), row.end(), [](float h) { return !std::isfinite(h); });
  return static_cast<int>(found - row.begin());
}

}  // namespace

void check_ground(const Heightfield& input, const std::string& op) {
  const Grid<float>& height = input.height;
  if (height.width() < 2 || height.height() < 2)
    throw Error(ErrorKind::input,
                fmt::format("'{}' needs ground of at least 2 x 2 samples; this has {} x {}", op,
                            height.width(), height.height()));
  if (!(input.cell > 0) || !std::isfinite(input.cell))
    throw Error(
        ErrorKind::input,
        fmt::format("'{}' needs samples a distance above 0 apart; these are {} m", op, input.cell));
  const int none = height.height();
  const int row = parallel_reduce(
      0, none, none,
      [&](int j) { return first_not_finite(height.row(j)) < height.width() ? j : none; },
      [](int a, int b) { return std::min(a, b); });
  if (row == none) return;
  throw Error(
      ErrorKind::input,
      fmt::format("'{}' needs heights that are finite numbers; sample ({}, {}), counted from "
                  "the south-west, has none",
                  op, first_not_finite(height.row(row)), row));
}

double volume(const Grid<float>& grid, double cell) {
  const double sum = parallel_reduce(
      0, grid.height(), 0.0,
      [&](int j) {
        double of_row = 0;
        for (const float v : grid.row(j)) of_row += static_cast<double>(v);
        return of_row;
      },
      [](double a, double b) { return a + b; });
  return sum * cell * cell;
}

Grid<float> factor_map(const Heightfield& input, const std::string& name, float otherwise,
                       const TerrainContext& context) {
  if (name.empty()) return {input.height.width(), input.height.height(), otherwise};
  Grid<float> map = map_over(input, name, context);
  parallel_for(0, map.height(), [&](int j) {
    for (float& v : map.row(j)) {
      if (!std::isfinite(v))
        throw Error(ErrorKind::input,
                    fmt::format("the map '{}' holds values that are not numbers", name));
      v = std::clamp(v, 0.0F, 1.0F);
    }
  });
  return map;
}

}  // namespace wold
