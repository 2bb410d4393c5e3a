#include "terrain/heightfield.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace wold {

namespace {

/// Catmull-Rom along one axis: four neighbouring samples, the weights of their values and, per
/// sample distance, of their derivative.
struct Axis {
  std::array<int, 4> index;
  std::array<float, 4> value;
  std::array<float, 4> slope;
  bool inside;  ///< the four indices are consecutive
};

std::array<float, 4> value_weights(float t) {
  const float u = 1 - t;
  return {-0.5F * t * u * u, 1 + t * t * (1.5F * t - 2.5F), 1 + u * u * (1.5F * u - 2.5F),
          -0.5F * u * t * t};
}

std::array<float, 4> slope_weights(float t) {
  const float u = 1 - t;
  return {-0.5F * u * (1 - 3 * t), t * (4.5F * t - 5), -u * (4.5F * u - 5), 0.5F * t * (3 * t - 2)};
}

/// Beyond the border the samples go on in a straight line, s(-1) = 2 s(0) - s(1), which is folded
/// into the weights of the samples that exist.
void fold_border(Axis& axis, int first, int count) {
  std::array<float, 4> value{};
  std::array<float, 4> slope{};
  const int begin = std::clamp(first, 0, std::max(0, count - 4));
  const auto add = [&](int sample, int from, float factor) {
    const auto to = static_cast<std::size_t>(std::clamp(sample, 0, count - 1) - begin);
    value[to] += factor * axis.value[static_cast<std::size_t>(from)];
    slope[to] += factor * axis.slope[static_cast<std::size_t>(from)];
  };
  for (int k = 0; k < 4; ++k) {
    const int sample = first + k;
    if (sample >= 0 && sample < count) {
      add(sample, k, 1);
    } else {
      const int beyond = sample < 0 ? -sample : sample - (count - 1);
      const int edge = sample < 0 ? 0 : count - 1;
      add(edge, k, static_cast<float>(1 + beyond));
      add(sample < 0 ? 1 : count - 2, k, static_cast<float>(-beyond));
    }
  }
  axis.value = value;
  axis.slope = slope;
  for (int k = 0; k < 4; ++k)
    axis.index[static_cast<std::size_t>(k)] = std::min(begin + k, count - 1);
}

Axis axis_at(double place, double origin, double cell, int count) {
  const double position = std::clamp((place - origin) / cell, 0.0, static_cast<double>(count - 1));
  const int cell_index = std::min(static_cast<int>(position), std::max(0, count - 2));
  const auto t = static_cast<float>(position - cell_index);
  Axis axis;
  axis.value = value_weights(t);
  axis.slope = slope_weights(t);
  const int first = cell_index - 1;
  axis.inside = first >= 0 && first + 4 <= count;
  if (axis.inside)
    axis.index = {first, first + 1, first + 2, first + 3};
  else
    fold_border(axis, first, count);
  return axis;
}

float dot(const std::array<float, 4>& weights, const std::array<float, 4>& samples) {
  return (weights[0] * samples[0] + weights[1] * samples[1]) +
         (weights[2] * samples[2] + weights[3] * samples[3]);
}

}  // namespace

bool Heightfield::contains(DVec2 place) const {
  const DVec2 p = place - origin;
  return p.x >= 0 && p.y >= 0 && p.x <= size().x && p.y <= size().y;
}

GroundSample ground_at(const Heightfield& field, DVec2 place) {
  const Grid<float>& grid = field.height;
  const Axis x = axis_at(place.x, field.origin.x, field.cell, grid.width());
  const Axis y = axis_at(place.y, field.origin.y, field.cell, grid.height());
  std::array<float, 4> height;
  std::array<float, 4> slope;
  for (std::size_t k = 0; k < 4; ++k) {
    const float* row = grid.row(y.index[k]).data();
    std::array<float, 4> samples;
    if (x.inside)
      std::copy_n(row + x.index[0], 4, samples.begin());
    else
      for (std::size_t c = 0; c < 4; ++c) samples[c] = row[x.index[c]];
    height[k] = dot(x.value, samples);
    slope[k] = dot(x.slope, samples);
  }
  const auto per_metre = static_cast<float>(1 / field.cell);
  return {dot(y.value, height), per_metre * Vec2(dot(y.value, slope), dot(y.slope, height))};
}

float height_at(const Heightfield& field, DVec2 place) {
  const Grid<float>& grid = field.height;
  const auto position = [&](double p, double origin, int count) {
    return std::clamp((p - origin) / field.cell, 0.0, static_cast<double>(count - 1));
  };
  const double x = position(place.x, field.origin.x, grid.width());
  const double y = position(place.y, field.origin.y, grid.height());
  const int i = std::min(static_cast<int>(x), std::max(0, grid.width() - 2));
  const int j = std::min(static_cast<int>(y), std::max(0, grid.height() - 2));
  const auto tx = static_cast<float>(x - i);
  const auto ty = static_cast<float>(y - j);
  const int i1 = std::min(i + 1, grid.width() - 1);
  const int j1 = std::min(j + 1, grid.height() - 1);
  const float south = grid(i, j) + tx * (grid(i1, j) - grid(i, j));
  const float north = grid(i, j1) + tx * (grid(i1, j1) - grid(i, j1));
  return south + ty * (north - south);
}

Vec3 normal_of(Vec2 gradient) {
  return glm::normalize(Vec3(-gradient.x, -gradient.y, 1));
}

}  // namespace wold
