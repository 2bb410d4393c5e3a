#include "erosion/droplet_maps.hpp"

#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "erosion/droplet_walk.hpp"

namespace wold {

namespace {

constexpr float metres_of_pass = 10;  // area per width that counts as one pass
constexpr int rows_of_task = 16;

template <class Value>
Grid<float> from_samples(int width, int height, const Value& value) {
  Grid<float> out(width, height);
  parallel_for(
      0, height,
      [&](int j) {
        const auto row = out.row(j);
        const std::size_t first = static_cast<std::size_t>(j) * row.size();
        for (std::size_t i = 0; i < row.size(); ++i) row[i] = value(first + i);
      },
      rows_of_task);
  return out;
}

/// The mean of the neighbours of a sample that is below them all; else its own value.
float without_speck(const Grid<float>& map, int i, int j) {
  float sum = 0;
  int count = 0;
  const float own = map(i, j);
  for (int y = std::max(0, j - 1); y <= std::min(map.height() - 1, j + 1); ++y)
    for (int x = std::max(0, i - 1); x <= std::min(map.width() - 1, i + 1); ++x) {
      if (x == i && y == j) continue;
      if (map(x, y) <= own) return own;
      sum += map(x, y);
      ++count;
    }
  return sum / static_cast<float>(count);
}

}  // namespace

Grid<float> discharge_map(const DropletRecord& record, int width, int height) {
  const double area = record.rain > 0 ? 1 / record.rain : 0;
  return from_samples(width, height, [&](std::size_t k) {
    return static_cast<float>(area * record.passes[k].count);
  });
}

Grid<float> velocity_map(const DropletRecord& record, int width, int height) {
  return from_samples(width, height, [&](std::size_t k) {
    if (record.passes[k].count == 0) return 0.0F;
    return droplet_speed_unit * static_cast<float>(record.passes[k].speed) /
           static_cast<float>(record.passes[k].count);
  });
}

Grid<float> flow_map(const Grid<float>& discharge, double cell, float contrast) {
  const float f = 0.2F * std::exp(-6.61F * contrast);
  const float keep = std::log1p(-f) / (metres_of_pass * static_cast<float>(cell));
  const Grid<float> flow = from_samples(discharge.width(), discharge.height(), [&](std::size_t k) {
    return -std::expm1(keep * discharge.values()[k]);
  });
  Grid<float> closed(flow.width(), flow.height());
  parallel_for(
      0, flow.height(),
      [&](int j) {
        for (int i = 0; i < flow.width(); ++i) closed(i, j) = without_speck(flow, i, j);
      },
      rows_of_task);
  return closed;
}

}  // namespace wold
