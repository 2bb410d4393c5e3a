#include "terrain/heightfield.hpp"

#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace wold {

namespace {

namespace simd = hwy::HWY_NAMESPACE;

using Four = std::array<float, 4>;

/// Catmull-Rom along one axis: the first of four neighbouring samples, and the weights of their
/// values and, per sample distance, of their derivative.
struct Axis {
  int first;
  Four value;
  Four slope;
};

/// A place between samples along one axis.
struct Position {
  int sample;  ///< to its left
  float t;     ///< from 0 to 1, to the next
};

Position position_of(double distance, double cells_per_metre, int count) {
  const double x = std::clamp(distance * cells_per_metre, 0.0, static_cast<double>(count - 1));
  const int sample = std::min(static_cast<int>(x), std::max(0, count - 2));
  return {sample, static_cast<float>(x - sample)};
}

Four value_weights(float t) {
  const float u = 1 - t;
  return {-0.5F * t * u * u, 1 + t * t * (1.5F * t - 2.5F), 1 + u * u * (1.5F * u - 2.5F),
          -0.5F * u * t * t};
}

Four slope_weights(float t) {
  const float u = 1 - t;
  return {-0.5F * u * (1 - 3 * t), t * (4.5F * t - 5), -u * (4.5F * u - 5), 0.5F * t * (3 * t - 2)};
}

Axis inner_axis(const Position& p) {
  return {p.sample - 1, value_weights(p.t), slope_weights(p.t)};
}

/// Near the border: beyond it the samples go on in a straight line, s(-1) = 2 s(0) - s(1), which is
/// folded into the weights of the samples that exist.
Axis border_axis(const Position& p, int count) {
  const Axis open = inner_axis(p);
  Axis axis{std::clamp(open.first, 0, std::max(0, count - 4)), {}, {}};
  const auto add = [&](int sample, std::size_t from, float factor) {
    const auto to = static_cast<std::size_t>(std::clamp(sample, 0, count - 1) - axis.first);
    axis.value[to] += factor * open.value[from];
    axis.slope[to] += factor * open.slope[from];
  };
  for (std::size_t k = 0; k < 4; ++k) {
    const int sample = open.first + static_cast<int>(k);
    const int edge = std::clamp(sample, 0, count - 1);
    const int beyond = std::abs(sample - edge);
    add(edge, k, static_cast<float>(1 + beyond));
    if (beyond > 0) add(sample < 0 ? 1 : count - 2, k, static_cast<float>(-beyond));
  }
  return axis;
}

float dot(const Four& a, const Four& b) {
  return (a[0] * b[0] + a[1] * b[1]) + (a[2] * b[2] + a[3] * b[3]);
}

/// `rows` are four rows of samples, each from the first of `x`.
GroundSample interpolated(const Axis& x, const Axis& y, const std::array<const float*, 4>& rows,
                          double cells_per_metre) {
  const simd::FixedTag<float, 4> lanes;
  auto values = simd::Zero(lanes);
  auto slopes = simd::Zero(lanes);
  for (std::size_t k = 0; k < 4; ++k) {
    const auto row = simd::LoadU(lanes, rows[k]);
    values = simd::MulAdd(simd::Set(lanes, y.value[k]), row, values);
    slopes = simd::MulAdd(simd::Set(lanes, y.slope[k]), row, slopes);
  }
  Four value;
  Four slope;
  simd::StoreU(values, lanes, value.data());
  simd::StoreU(slopes, lanes, slope.data());
  const auto scale = static_cast<float>(cells_per_metre);
  return {dot(x.value, value), scale * Vec2(dot(x.slope, value), dot(x.value, slope))};
}

GroundSample ground_near_border(const Grid<float>& grid, const Position& px, const Position& py,
                                double cells_per_metre) {
  const Axis x = border_axis(px, grid.width());
  const Axis y = border_axis(py, grid.height());
  std::array<Four, 4> samples;
  for (int k = 0; k < 4; ++k)
    for (int c = 0; c < 4; ++c)
      samples[static_cast<std::size_t>(k)][static_cast<std::size_t>(c)] =
          grid.clamped(x.first + c, y.first + k);
  return interpolated(x, y,
                      {samples[0].data(), samples[1].data(), samples[2].data(), samples[3].data()},
                      cells_per_metre);
}

}  // namespace

bool Heightfield::contains(DVec2 place) const {
  const DVec2 p = place - origin;
  return p.x >= 0 && p.y >= 0 && p.x <= size().x && p.y <= size().y;
}

GroundSample ground_at(const Heightfield& field, DVec2 place) {
  const Grid<float>& grid = field.height;
  const double cells_per_metre = 1 / field.cell;
  const Position px = position_of(place.x - field.origin.x, cells_per_metre, grid.width());
  const Position py = position_of(place.y - field.origin.y, cells_per_metre, grid.height());
  const bool inside = px.sample >= 1 && px.sample + 3 <= grid.width() && py.sample >= 1 &&
                      py.sample + 3 <= grid.height();
  if (!inside) return ground_near_border(grid, px, py, cells_per_metre);
  const float* first = grid.row(py.sample - 1).data() + (px.sample - 1);
  const std::ptrdiff_t stride = grid.width();
  return interpolated(inner_axis(px), inner_axis(py),
                      {first, first + stride, first + 2 * stride, first + 3 * stride},
                      cells_per_metre);
}

float height_at(const Heightfield& field, DVec2 place) {
  const Grid<float>& grid = field.height;
  const double cells_per_metre = 1 / field.cell;
  const Position x = position_of(place.x - field.origin.x, cells_per_metre, grid.width());
  const Position y = position_of(place.y - field.origin.y, cells_per_metre, grid.height());
  const int i = x.sample;
  const int j = y.sample;
  const int i1 = std::min(i + 1, grid.width() - 1);
  const int j1 = std::min(j + 1, grid.height() - 1);
  const float south = grid(i, j) + x.t * (grid(i1, j) - grid(i, j));
  const float north = grid(i, j1) + x.t * (grid(i1, j1) - grid(i, j1));
  return south + y.t * (north - south);
}

Vec3 normal_of(Vec2 gradient) {
  return glm::normalize(Vec3(-gradient.x, -gradient.y, 1));
}

}  // namespace wold
