#include "erosion/stream_power_solver.hpp"

#include <algorithm>
#include <cmath>

#include "base/hash.hpp"

namespace wold {

namespace {

constexpr int tabled_counts = 8192;
constexpr double rain_unit = 256;

constexpr std::size_t at(int k) {
  return static_cast<std::size_t>(k);
}

/// 32 random bits of a sample and a step: an integer hash cheap in vectors (the mixer of
/// "lowbias32", Wellons 2018).
std::uint32_t step_bits(std::uint32_t key, int i, int j) {
  std::uint32_t x = key + static_cast<std::uint32_t>(i) * 0x9e3779b9U +
                    static_cast<std::uint32_t>(j) * 0x85ebca6bU;
  x ^= x >> 16U;
  x *= 0x7feb352dU;
  x ^= x >> 15U;
  x *= 0x846ca68bU;
  return x ^ (x >> 16U);
}

/// A random factor of a neighbour in 1 ± spread / 2, from 4 of the bits.
float chance(std::uint32_t bits, int d, float spread) {
  const auto part = static_cast<int>((bits >> (4U * static_cast<unsigned>(d))) & 15U);
  return (1 - spread / 2) + static_cast<float>(part) * (spread / 15);
}

/// Weights of falls to the neighbours for the slope (Sobel), and directions to them.
constexpr float sobel_x(int d) {
  return static_cast<float>(flow_dx[at(d)] * (flow_dy[at(d)] == 0 ? 2 : 1));
}
constexpr float sobel_y(int d) {
  return static_cast<float>(flow_dy[at(d)] * (flow_dx[at(d)] == 0 ? 2 : 1));
}
constexpr float unit_x(int d) {
  return static_cast<float>(flow_dx[at(d)] / flow_distance(d));
}
constexpr float unit_y(int d) {
  return static_cast<float>(flow_dy[at(d)] / flow_distance(d));
}

/// The implicit step for n other than 1: x = h' - h'_r with x - x0 + f x^n = 0, from above.
float newton(float x0, double f, double n) {
  double x = static_cast<double>(x0);
  for (int k = 0; k < 20; ++k) {
    const double power = f * std::pow(x, n);
    const double next = x - (x - static_cast<double>(x0) + power) / (1 + n * power / x);
    const bool done = std::abs(next - x) < 1e-7 * x;
    x = std::max(next, 1e-3 * x);
    if (done) break;
  }
  return static_cast<float>(x);
}

}  // namespace

StreamPowerSolver::StreamPowerSolver(double cell, const StreamPowerLaw& law,
                                     StreamPowerGround ground, const StreamPowerMesh& mesh,
                                     std::uint64_t seed, Progress& progress)
    : cell_(cell),
      law_(law),
      ground_(std::move(ground)),
      progress_(progress),
      seed_(seed),
      shifted_(mesh.is_real),
      steepest_(ground_.talus),
      direction_(ground_.uplift.width(), ground_.uplift.height()),
      powers_(tabled_counts) {
  if (shifted_)
    for (int d = 0; d < 4; ++d) nearness_[at(d)] = mesh.nearness(d, progress);
  for (int c = 0; c < tabled_counts; ++c)
    powers_[at(c)] = static_cast<float>(std::pow(c * cell * cell, law.area_exponent));
}

std::uint8_t StreamPowerSolver::direction_at(const Grid<float>& height, int i, int j) const {
  const auto spread = static_cast<float>(law_.wandering);
  float steepest = 0;
  std::uint8_t direction =
      law_.open.hold(i, j, height.width(), height.height()) ? flow_leaves : flow_stops;
  const std::uint32_t bits = step_bits(step_key_, i, j);
  for (int d = 0; d < 8; ++d) {
    const int x = i + flow_dx[at(d)];
    const int y = j + flow_dy[at(d)];
    if (x < 0 || y < 0 || x >= height.width() || y >= height.height()) continue;
    const float near = !shifted_ ? static_cast<float>(1 / flow_distance(d))
                       : d < 4   ? nearness_[at(d)](i, j)
                                 : nearness_[at(d - 4)](x, y);
    const float slope = (height(i, j) - height(x, y)) * near * chance(bits, d, spread);
    if (slope > steepest) {
      steepest = slope;
      direction = static_cast<std::uint8_t>(d);
    }
  }
  return direction;
}

template <bool shifted>
void StreamPowerSolver::directions_of_row(const Grid<float>& height, int j) {
  const int w = height.width();
  std::array<const float*, 8> near{};
  if (shifted)
    for (int d = 0; d < 4; ++d) {
      near[at(d)] = nearness_[at(d)].row(j).data();
      near[at(d + 4)] = near[at(d)] + flow_step(d + 4, w);
    }
  const auto spread = static_cast<float>(law_.wandering);
  const float* here = height.row(j).data();
  std::uint8_t* out = direction_.row(j).data();
  constexpr int chunk = 256;
  std::array<int, chunk> best;
  std::array<float, chunk> cosine;
  for (int first = 1; first < w - 1; first += chunk) {
    const int count = std::min(chunk, w - 1 - first);
    for (int c = 0; c < count; ++c) {
      const int i = first + c;
      const std::uint32_t bits = step_bits(step_key_, i, j);
      float steepest = 0;
      int direction = flow_stops;
      float fall_x = 0;
      float fall_y = 0;
      float along = 0;
      for (int d = 0; d < 8; ++d) {
        const float nearness = shifted ? near[at(d)][i] : static_cast<float>(1 / flow_distance(d));
        const float fall = here[i] - here[i + flow_step(d, w)];
        fall_x += fall * sobel_x(d);
        fall_y += fall * sobel_y(d);
        const float slope = fall * nearness * chance(bits, d, spread);
        const bool steeper = slope > steepest;
        direction = steeper ? d : direction;
        steepest = steeper ? slope : steepest;
      }
      for (int d = 0; d < 8; ++d)
        along = direction == d ? fall_x * unit_x(d) + fall_y * unit_y(d) : along;
      best[at(c)] = direction;
      const float length = std::sqrt(fall_x * fall_x + fall_y * fall_y + 1e-12F);
      cosine[at(c)] = std::min(1.0F, std::max(0.7F, along / length));
    }
    for (int c = 0; c < count; ++c) out[first + c] = static_cast<std::uint8_t>(best[at(c)]);
    float* steepest = &steepest_(0, j);
    const float* talus = &ground_.talus(0, j);
    for (int c = 0; c < count; ++c) steepest[first + c] = talus[first + c] * cosine[at(c)];
  }
}

void StreamPowerSolver::find_directions(const Grid<float>& height) {
  const int w = height.width();
  const int h = height.height();
  parallel_for(
      0, h,
      [&](int j) {
        progress_.advance(w);
        if (j == 0 || j == h - 1) {
          for (int i = 0; i < w; ++i) direction_(i, j) = direction_at(height, i, j);
          return;
        }
        direction_(0, j) = direction_at(height, 0, j);
        direction_(w - 1, j) = direction_at(height, w - 1, j);
        if (shifted_)
          directions_of_row<true>(height, j);
        else
          directions_of_row<false>(height, j);
      },
      8);
}

template <class Amount>
void StreamPowerSolver::find_order(Grid<Amount>& amounts) {
  order_.build(direction_, amounts.values(), progress_);
}

template <class AreaPower>
void StreamPowerSolver::erode(Grid<float>& height, double years, const AreaPower& area_power) {
  struct Neighbour {
    int step = 0;
    float distance = 0;
    float factor = 0;
  };
  std::array<Neighbour, 8> to{};
  for (int d = 0; d < 8; ++d)
    to[at(d)] = {
        flow_step(d, height.width()), static_cast<float>(cell_ * flow_distance(d)),
        static_cast<float>(years / std::pow(cell_ * flow_distance(d), law_.slope_exponent))};
  float* h = height.values().data();
  const float* uplift = ground_.uplift.values().data();
  const float* erodibility = ground_.erodibility.values().data();
  const float* talus = steepest_.values().data();
  const std::uint8_t* direction = direction_.values().data();
  const bool linear = law_.slope_exponent == 1;
  const double n = law_.slope_exponent;
  order_.downstream_first([&](int k) {
    const int d = direction[k];
    if (d == flow_leaves) return;
    const float raised = h[k] + uplift[k] * static_cast<float>(years);
    if (d == flow_stops) {
      h[k] = raised;
      return;
    }
    Neighbour r = to[at(d)];
    if (shifted_) {
      const float near =
          d < 4 ? nearness_[at(d)].values()[at(k)] : nearness_[at(d - 4)].values()[at(k + r.step)];
      r.distance = static_cast<float>(cell_) / near;
      r.factor = static_cast<float>(years / std::pow(static_cast<double>(r.distance), n));
    }
    const float base = h[k + r.step];
    if (raised <= base) {
      h[k] = raised;
      return;
    }
    const float f = erodibility[k] * area_power(k) * r.factor;
    const float above = raised - base;
    const float stays = linear ? above / (1 + f) : newton(above, static_cast<double>(f), n);
    h[k] = base + std::min(stays, talus[k] * r.distance);
  });
}

void StreamPowerSolver::step(Grid<float>& height, double years) {
  step_key_ = static_cast<std::uint32_t>(random_bits(seed_, steps_++));
  find_directions(height);
  pits_ = router_.route(height, direction_, law_.open, progress_);
  const double m = law_.area_exponent;
  const double cell_area = cell_ * cell_;
  if (ground_.rain.empty()) {
    if (count_.empty()) count_ = Grid<std::int32_t>(height.width(), height.height());
    std::fill(count_.values().begin(), count_.values().end(), 1);
    find_order(count_);
    const std::int32_t* count = count_.values().data();
    erode(height, years, [&](int k) {
      const std::int32_t c = count[k];
      return c < tabled_counts ? powers_[at(c)]
                               : std::pow(static_cast<float>(c * cell_area), static_cast<float>(m));
    });
  } else {
    rain_ = Grid<std::int64_t>(height.width(), height.height());
    std::copy(ground_.rain.values().begin(), ground_.rain.values().end(), rain_.values().begin());
    find_order(rain_);
    const std::int64_t* rain = rain_.values().data();
    erode(height, years, [&](int k) {
      return std::pow(static_cast<float>(static_cast<double>(rain[k]) * cell_area / rain_unit),
                      static_cast<float>(m));
    });
  }
  diffuse(height, law_.diffusivity * years / cell_area, {}, progress_);
}

Grid<float> StreamPowerSolver::area() const {
  Grid<float> out(direction_.width(), direction_.height());
  const double cell_area = cell_ * cell_;
  for (std::size_t k = 0; k < out.size(); ++k)
    out.values()[k] = static_cast<float>(rain_.empty() ? count_.values()[k] * cell_area
                                                       : static_cast<double>(rain_.values()[k]) *
                                                             cell_area / rain_unit);
  return out;
}

}  // namespace wold
