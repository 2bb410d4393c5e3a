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
Grid<float> from_samples(int width, int height, Progress& progress, const Value& value) {
  Grid<float> out(width, height);
  parallel_for(
      0, height,
      [&](int j) {
        const auto row = out.row(j);
        for (std::size_t i = 0; i < row.size(); ++i) row[i] = value(i, static_cast<std::size_t>(j));
        progress.advance(0);
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

/// The one of a sample among those in padded rows.
const DropletPasses& passes_at(const DropletRecord& record, int width, std::size_t i,
                               std::size_t j) {
  return record.passes[j * static_cast<std::size_t>(droplet_stride(width)) + i];
}

}  // namespace

Grid<float> discharge_map(const DropletRecord& record, int width, int height, Progress& progress) {
  const double area = record.rain > 0 ? 1 / record.rain : 0;
  return from_samples(width, height, progress, [&](std::size_t i, std::size_t j) {
    return static_cast<float>(area * passes_at(record, width, i, j).count);
  });
}

Grid<float> velocity_map(const DropletRecord& record, int width, int height, Progress& progress) {
  return from_samples(width, height, progress, [&](std::size_t i, std::size_t j) {
    const DropletPasses& here = passes_at(record, width, i, j);
    if (here.count == 0) return 0.0F;
    return droplet_speed_unit * static_cast<float>(here.speed) / static_cast<float>(here.count);
  });
}

Grid<float> flow_map(const Grid<float>& discharge, double cell, float contrast,
                     Progress& progress) {
  const float f = 0.2F * std::exp(-6.61F * contrast);
  const float keep = std::log1p(-f) / (metres_of_pass * static_cast<float>(cell));
  const Grid<float> flow = from_samples(
      discharge.width(), discharge.height(), progress, [&](std::size_t i, std::size_t j) {
        return -std::expm1(keep * discharge(static_cast<int>(i), static_cast<int>(j)));
      });
  Grid<float> closed(flow.width(), flow.height());
  parallel_for(
      0, flow.height(),
      [&](int j) {
        for (int i = 0; i < flow.width(); ++i) closed(i, j) = without_speck(flow, i, j);
        progress.advance(0);
      },
      rows_of_task);
  return closed;
}

}  // namespace wold
