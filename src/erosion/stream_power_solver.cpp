#include "erosion/stream_power_solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/hash.hpp"

namespace wold {

namespace {

constexpr int tabled_counts = 8192;
constexpr double rain_unit = 256;
constexpr int visits_between_reports = 1 << 14;
constexpr float stream_area = 2000;  // m², from which sediment is laid down
constexpr float rests_up_to = 0.7F;  // of the talus slope; sediment does not rest on steeper ground

constexpr std::size_t at(int k) {
  return static_cast<std::size_t>(k);
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
      cosine_(ground_.talus.width(), ground_.talus.height(), 1),
      direction_(ground_.uplift.width(), ground_.uplift.height()),
      powers_(tabled_counts) {
  if (shifted_)
    for (int d = 0; d < 4; ++d) nearness_[at(d)] = mesh.nearness(d, progress);
  for (int c = 0; c < tabled_counts; ++c)
    powers_[at(c)] = static_cast<float>(std::pow(c * cell * cell, law.area_exponent));
}

DirectionRow StreamPowerSolver::direction_row(const Grid<float>& height, int j) const {
  const int w = height.width();
  DirectionRow row{.height = height.row(j).data(),
                   .width = w,
                   .row = j,
                   .key = step_key_,
                   .wandering = static_cast<float>(law_.wandering)};
  if (shifted_)
    for (int d = 0; d < 4; ++d) {
      row.nearness[at(d)] = nearness_[at(d)].row(j).data();
      row.nearness[at(d + 4)] = row.nearness[at(d)] + flow_step(d + 4, w);
    }
  return row;
}

std::uint8_t StreamPowerSolver::border_direction(const Grid<float>& height, int i, int j) const {
  const DirectionRow row = direction_row(height, j);
  float steepest = 0;
  std::uint8_t direction =
      law_.open.hold(i, j, height.width(), height.height()) ? flow_leaves : flow_stops;
  for (int d = 0; d < 8; ++d) {
    const int x = i + flow_dx[at(d)];
    const int y = j + flow_dy[at(d)];
    if (x < 0 || y < 0 || x >= height.width() || y >= height.height()) continue;
    const float near = shifted_ ? row.nearness[at(d)][i] : static_cast<float>(1 / flow_distance(d));
    const float slope = (height(i, j) - height(x, y)) * near * slope_chance(row, i, d);
    if (slope > steepest) {
      steepest = slope;
      direction = static_cast<std::uint8_t>(d);
    }
  }
  return direction;
}

void StreamPowerSolver::find_directions(const Grid<float>& height) {
  const int w = height.width();
  const int h = height.height();
  parallel_for(
      0, h,
      [&](int j) {
        progress_.advance(w);
        if (j == 0 || j == h - 1) {
          for (int i = 0; i < w; ++i) direction_(i, j) = border_direction(height, i, j);
          return;
        }
        wold::find_directions(direction_row(height, j), direction_.row(j).data(),
                              cosine_.row(j).data());
        direction_(0, j) = border_direction(height, 0, j);
        direction_(w - 1, j) = border_direction(height, w - 1, j);
      },
      8);
}

template <class Amount>
void StreamPowerSolver::find_order(Grid<Amount>& amounts) {
  order_.build(direction_, amounts.values(), progress_);
  progress_.advance(0);
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
  const float* talus = ground_.talus.values().data();
  const float* cosine = cosine_.values().data();
  const std::uint8_t* direction = direction_.values().data();
  if (law_.deposition > 0 && load_.empty()) load_ = Grid<double>(height.width(), height.height());
  double* load = load_.empty() ? nullptr : load_.values().data();
  const bool linear = law_.slope_exponent == 1;
  const double n = law_.slope_exponent;
  order_.downstream_first([&](int k) {
    const int d = direction[k];
    if (k % visits_between_reports == 0) progress_.advance(0);
    if (load != nullptr) load[k] = 0;
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
    h[k] = base + std::min(stays, talus[k] * cosine[k] * r.distance);
    if (load != nullptr) load[k] = static_cast<double>(raised) - static_cast<double>(h[k]);
  });
}

void StreamPowerSolver::deposit(Grid<float>& height) {
  const int w = height.width();
  const auto cell_area = static_cast<float>(cell_ * cell_);
  const auto share = static_cast<float>(law_.deposition);
  order_.upstream_first([&](int k) {
    if (k % visits_between_reports == 0) progress_.advance(0);
    double& load = load_.values()[at(k)];  // eroded here so far
    float& h = height.values()[at(k)];
    float& lies = sediment_.values()[at(k)];
    lies = std::max(0.0F, lies - static_cast<float>(load));
    float lowest_donor = std::numeric_limits<float>::infinity();
    each_donor(direction_, k, [&](int n) {
      load += load_.values()[at(n)];
      lowest_donor = std::min(lowest_donor, height.values()[at(n)]);
    });
    const int d = direction_.values()[at(k)];
    if (d >= flow_stops) return;
    const float spill = height.values()[at(k + flow_step(d, w))];
    const auto distance = static_cast<float>(cell_ * flow_distance(d));
    const float area = area_at(k);
    if (area < stream_area) return;
    if (h - spill > rests_up_to * ground_.talus.values()[at(k)] * distance) return;
    const float room = spill > h ? spill - h : std::max(0.0F, 0.5F * (lowest_donor - h));
    const float wanted =
        spill > h ? room
                  : share * static_cast<float>(load) * cell_area / (area + share * cell_area);
    const float before = h;
    h += std::min({wanted, room, static_cast<float>(load)});
    load = std::max(0.0, load - (static_cast<double>(h) - static_cast<double>(before)));
    lies += h - before;
  });
}

void StreamPowerSolver::step(Grid<float>& height, double years) {
  step_key_ = static_cast<std::uint32_t>(random_bits(seed_, steps_++));
  find_directions(height);
  pits_ = router_.route(height, direction_, law_.open, progress_);
  progress_.advance(0);
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
  progress_.advance(0);
  if (law_.deposition > 0) {
    if (sediment_.empty()) sediment_ = Grid<float>(height.width(), height.height(), 0);
    deposit(height);
    progress_.advance(0);
  }
  diffuse(height, law_.diffusivity * years / cell_area, {}, progress_);
}

float StreamPowerSolver::area_at(int k) const {
  const double samples = rain_.empty() ? count_.values()[at(k)]
                                       : static_cast<double>(rain_.values()[at(k)]) / rain_unit;
  return static_cast<float>(samples * cell_ * cell_);
}

Grid<float> StreamPowerSolver::area() const {
  Grid<float> out(direction_.width(), direction_.height());
  for (std::size_t k = 0; k < out.size(); ++k) out.values()[k] = area_at(static_cast<int>(k));
  return out;
}

}  // namespace wold
