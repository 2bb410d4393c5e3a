#include "erosion/pipes_ladder.hpp"

#include <algorithm>
#include <cmath>
#include <queue>

#include "base/parallel.hpp"
#include "terrain/resample.hpp"
#include "terrain/step_cell.hpp"

namespace wold::pipes_detail {

namespace {

constexpr double time_on_next = 0.25;  // of the time on a rung
constexpr double samples_at_first = 128;

double sum_of(const Grid<float>& grid, bool positive) {
  return parallel_reduce(
      0, grid.height(), 0.0,
      [&](int j) {
        double sum = 0;
        for (const float v : grid.row(j))
          if ((v > 0) == positive) sum += static_cast<double>(v);
        return sum;
      },
      [](double a, double b) { return a + b; });
}

TerrainDomain extent_of(const Heightfield& field) {
  return {field.origin, field.size()};
}

}  // namespace

std::vector<Heightfield> ladder_of(const Heightfield& input, double start_cell) {
  const DVec2 size = input.size();
  const double first = start_cell > 0 ? start_cell : std::max(size.x, size.y) / samples_at_first;
  std::vector<Heightfield> rungs;
  // Never fewer than 9 samples across, and none much like the last.
  const double coarsest = std::min({first, size.x / 8, size.y / 8});
  for (double cell = coarsest; cell > 1.41 * input.cell; cell /= 2)
    rungs.push_back(field_with_cell(input, cell));
  rungs.push_back(
      {Grid<float>(input.height.width(), input.height.height()), input.origin, input.cell});
  return rungs;
}

double seconds_on(int rung, const Pipes& parameters) {
  return 3600 * static_cast<double>(parameters.duration) * std::pow(time_on_next, rung);
}

Grid<Grains> to_grains(const Grid<float>& metres, double cell, double volume) {
  const double up = sum_of(metres, true);
  const double down = sum_of(metres, false);
  const double lacking = volume / (cell * cell) - (up + down);
  const bool scale_up = up >= -down;
  const double part = scale_up ? up : down;
  const double factor = part != 0 ? 1 + lacking / part : 1;
  Grid<Grains> out(metres.width(), metres.height());
  double left = 0;
  for (std::size_t k = 0; k < out.size(); ++k) {
    const float v = metres.values()[k];
    if (v == 0) continue;
    const double scaled = static_cast<double>(v) * ((v > 0) == scale_up ? factor : 1.0);
    const double exact = scaled * static_cast<double>(grains_per_metre) + left;
    // Neither rounding nor what is left may turn water into less than none.
    const double whole = v > 0 ? std::max(std::round(exact), 0.0) : std::round(exact);
    left = exact - whole;
    out.values()[k] = static_cast<Grains>(std::clamp(whole, -1.5e9, 1.5e9));
  }
  return out;
}

Grid<float> to_metres(const Grid<Grains>& grains) {
  Grid<float> out(grains.width(), grains.height());
  for (std::size_t k = 0; k < out.size(); ++k)
    out.values()[k] = metres_per_grain * static_cast<float>(grains.values()[k]);
  return out;
}

double volume_of(const Grid<Grains>& grains, double cell) {
  std::int64_t sum = 0;
  for (const Grains g : grains.values()) sum += g;
  return static_cast<double>(sum) * static_cast<double>(metres_per_grain) * cell * cell;
}

Grid<float> hollow_depth(const Heightfield& ground) {
  struct Cell {
    float level;
    int i;
    int j;
    bool operator<(const Cell& b) const {
      if (level != b.level) return level > b.level;
      return j != b.j ? j > b.j : i > b.i;
    }
  };
  const int width = ground.height.width();
  const int height = ground.height.height();
  Grid<float> depth(width, height, -1);
  std::priority_queue<Cell> border;
  const auto reach = [&](int i, int j, float level) {
    if (i < 0 || i >= width || j < 0 || j >= height || depth(i, j) >= 0) return;
    const float at = ground.height(i, j);
    depth(i, j) = std::max(level - at, 0.0F);
    border.push({std::max(level, at), i, j});
  };
  for (int j = 0; j < height; ++j)
    for (int i = 0; i < width; ++i)
      if (i == 0 || j == 0 || i == width - 1 || j == height - 1) reach(i, j, ground.height(i, j));
  while (!border.empty()) {
    const Cell c = border.top();
    border.pop();
    reach(c.i - 1, c.j, c.level);
    reach(c.i + 1, c.j, c.level);
    reach(c.i, c.j - 1, c.level);
    reach(c.i, c.j + 1, c.level);
  }
  return depth;
}

Brought bring(const PipeSolver& from, const Heightfield& to, Progress& progress) {
  const Heightfield& coarse = from.ground();
  const auto over = [&](const Grid<float>& grid) {
    return resample(grid, extent_of(coarse), Outside::clamp, to, progress);
  };
  const Grid<float> shape = over(coarse.height);
  Grid<float> depth = over(to_metres(from.depth()));
  Grid<float> sediment = over(to_metres(from.sediment()));
  progress.advance(0);
  for (std::size_t k = 0; k < depth.size(); ++k) {
    // The surface stays where the water is deep; where it is thin it follows the ground.
    const float d = std::max(depth.values()[k], 0.0F);
    const float lower = shape.values()[k] - to.height.values()[k];
    depth.values()[k] = d + std::clamp(lower, -d, d);
    sediment.values()[k] = std::max(sediment.values()[k], 0.0F);
  }
  const auto exact = [&](const Grid<float>& grid, const Grid<Grains>& before) {
    progress.advance(0);
    return to_grains(grid, to.cell, volume_of(before, coarse.cell));
  };
  return {exact(over(to_metres(from.change())), from.change()), exact(depth, from.depth()),
          exact(sediment, from.sediment())};
}

}  // namespace wold::pipes_detail
