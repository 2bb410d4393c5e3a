#include "terrain/step_cell.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/memory.hpp"
#include "terrain/field_map.hpp"
#include "terrain/resample.hpp"

namespace wold {

namespace {

TerrainDomain extent_of(const Heightfield& field) {
  return {field.origin, field.size()};
}

void check_size(const TerrainOperator& op, const Heightfield& input, double cell) {
  const DVec2 samples = input.size() / cell + 1.0;
  const double needed = samples.x * samples.y * (op.bytes_per_sample + 3 * sizeof(float));
  const auto available = static_cast<double>(available_memory());
  const bool fits = available <= 0 || needed <= 0.9 * available;
  if (fits && std::max(samples.x, samples.y) < 1e6) return;
  throw Error(ErrorKind::limit,
              fmt::format("'{}' with a cell of {:g} m works on {:.0f} x {:.0f} samples, which need "
                          "about {}, but {} are free",
                          op.name(), cell, samples.x, samples.y, memory_text(needed),
                          memory_text(available)));
}

}  // namespace

Heightfield field_with_cell(const Heightfield& like, double cell) {
  const DVec2 size = like.size();
  const int width = std::max(2, static_cast<int>(std::lround(size.x / cell)) + 1);
  Heightfield field;
  field.origin = like.origin;
  field.cell = size.x / (width - 1);
  const int height = std::max(2, static_cast<int>(std::lround(size.y / field.cell)) + 1);
  field.height = Grid<float>(width, height);
  return field;
}

TerrainResult run_at_cell(const TerrainOperator& op, const Heightfield& input,
                          const Described& parameters, double cell, const TerrainContext& context) {
  if (cell <= 0 || op.makes_ground) return op.run(input, parameters, context);
  check_size(op, input, cell);
  Progress& progress = context.progress;
  Heightfield before = field_with_cell(input, cell);
  before.height = resample(input.height, extent_of(input), Outside::clamp, before, progress);
  TerrainResult result = op.run(before, parameters, context);
  Grid<float> change = map_grid<float>(before, progress, [&](int i, int j) {
    return result.field.height(i, j) - before.height(i, j);
  });
  const auto brought_back = [&](const Grid<float>& grid) {
    return resample(grid, extent_of(before), Outside::clamp, input, progress);
  };
  change = brought_back(change);
  result.field = map_heights(input, context,
                             [&](float height, int i, int j) { return height + change(i, j); });
  for (auto& [name, map] : result.maps) map = brought_back(map);
  return result;
}

}  // namespace wold
