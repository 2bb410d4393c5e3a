#include "terrain/analysis.hpp"

#include <cmath>

#include "base/parallel.hpp"

namespace wold {

namespace {

template <class T, class Function>
Grid<T> map_samples(const Heightfield& field, const Function& function) {
  Grid<T> out(field.height.width(), field.height.height());
  parallel_for(
      0, out.height(),
      [&](int j) {
        const std::span<T> row = out.row(j);
        for (int i = 0; i < out.width(); ++i) row[static_cast<std::size_t>(i)] = function(i, j);
      },
      16);
  return out;
}

/// Second derivative along one axis; at the border that of the nearest sample inside.
float second_difference(float before, float at, float after, double cell) {
  return static_cast<float>((static_cast<double>(before) - 2.0 * at + after) / (cell * cell));
}

}  // namespace

HeightStatistics height_statistics(const Heightfield& field) {
  if (field.height.empty()) return {};
  struct Sum {
    float min;
    float max;
    double sum;
  };
  const float first = field.height(0, 0);
  const Sum total = parallel_reduce(
      0, field.height.height(), Sum{first, first, 0},
      [&](int j) {
        Sum row{first, first, 0};
        for (const float h : field.height.row(j))
          row = {std::min(row.min, h), std::max(row.max, h), row.sum + h};
        return row;
      },
      [](const Sum& a, const Sum& b) {
        return Sum{std::min(a.min, b.min), std::max(a.max, b.max), a.sum + b.sum};
      });
  return {total.min, total.max, total.sum / static_cast<double>(field.height.size())};
}

Vec2 gradient_at_sample(const Heightfield& field, int i, int j) {
  const Grid<float>& h = field.height;
  const int west = std::max(i - 1, 0);
  const int east = std::min(i + 1, h.width() - 1);
  const int south = std::max(j - 1, 0);
  const int north = std::min(j + 1, h.height() - 1);
  const auto slope = [&](float low, float high, int cells) {
    return cells > 0 ? static_cast<float>((high - low) / (field.cell * cells)) : 0.0F;
  };
  return {slope(h(west, j), h(east, j), east - west),
          slope(h(i, south), h(i, north), north - south)};
}

float slope_at_sample(const Heightfield& field, int i, int j) {
  return degrees(std::atan(glm::length(gradient_at_sample(field, i, j))));
}

Grid<float> slope_map(const Heightfield& field) {
  return map_samples<float>(field, [&](int i, int j) { return slope_at_sample(field, i, j); });
}

Grid<float> curvature_map(const Heightfield& field) {
  const Grid<float>& h = field.height;
  const auto inner = [](int k, int count) {
    return std::clamp(k, std::min(1, count - 1), std::max(count - 2, 0));
  };
  return map_samples<float>(field, [&](int i, int j) {
    const int x = inner(i, h.width());
    const int y = inner(j, h.height());
    return second_difference(h.clamped(x - 1, j), h.clamped(x, j), h.clamped(x + 1, j),
                             field.cell) +
           second_difference(h.clamped(i, y - 1), h.clamped(i, y), h.clamped(i, y + 1), field.cell);
  });
}

Grid<Vec3> normal_map(const Heightfield& field) {
  return map_samples<Vec3>(
      field, [&](int i, int j) { return normal_of(gradient_at_sample(field, i, j)); });
}

Grid<float> hillshade(const Heightfield& field, const Hillshade& light) {
  const float azimuth = radians(light.azimuth);
  const float elevation = radians(light.elevation);
  const Vec3 to_light(std::cos(elevation) * std::sin(azimuth),
                      std::cos(elevation) * std::cos(azimuth), std::sin(elevation));
  return map_samples<float>(field, [&](int i, int j) {
    const Vec3 normal = normal_of(light.exaggeration * gradient_at_sample(field, i, j));
    const float lit = std::max(0.0F, glm::dot(normal, to_light));
    return light.ambient + (1 - light.ambient) * lit;
  });
}

}  // namespace wold
