#include "erosion/drainage_area.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "base/parallel.hpp"
#include "base/vec.hpp"
#include "erosion/flow_routing.hpp"

namespace wold {

namespace {

/// What each neighbour gets; sums to 1, or to 0 where nothing is lower.
using Shares = std::array<double, 8>;

std::size_t at(int k) {
  return static_cast<std::size_t>(k);
}

/// A sample with its neighbours; there is none beyond the border.
class Place {
 public:
  Place(const Grid<float>& height, int i, int j) : height_(height), i_(i), j_(j) {}

  bool has(int d) const {
    const int x = i_ + flow_dx[at(d & 7)];
    const int y = j_ + flow_dy[at(d & 7)];
    return x >= 0 && y >= 0 && x < height_.width() && y < height_.height();
  }
  /// Fall to a neighbour, m.
  double fall(int d) const {
    return static_cast<double>(height_(i_, j_)) -
           static_cast<double>(height_(i_ + flow_dx[at(d & 7)], j_ + flow_dy[at(d & 7)]));
  }

 private:
  const Grid<float>& height_;
  int i_;
  int j_;
};

struct Descent {
  double slope = 0;       ///< m per cell
  double direction = -1;  ///< in units of 45°

  void keep_steeper(double other_slope, double other_direction) {
    if (other_slope > slope) *this = {other_slope, other_direction};
  }
};

/// The triangle between the neighbour along an axis and the diagonal that is `turn` (1 or -1) from
/// it.
void keep_triangle(const Place& place, int axis, int turn, Descent& best) {
  const int diagonal = (axis + turn) & 7;
  if (!place.has(axis) || !place.has(diagonal)) return;
  const double s1 = place.fall(axis);
  const double s2 = place.fall(diagonal) - s1;
  if (s2 <= 0 || s1 <= s2) return;  // steepest along an edge
  const double angle = std::atan2(s2, s1) / (pi_d / 4);
  double direction = axis + turn * angle;
  if (direction < 0) direction += 8;
  best.keep_steeper(std::hypot(s1, s2), direction);
}

float d_infinity_at(const Grid<float>& height, int i, int j) {
  const Place place(height, i, j);
  Descent best;
  for (int d = 0; d < 8; ++d)
    if (place.has(d)) best.keep_steeper(place.fall(d) / flow_distance(d), d);
  for (int axis = 0; axis < 8; axis += 2) {
    keep_triangle(place, axis, 1, best);
    keep_triangle(place, axis, -1, best);
  }
  return static_cast<float>(best.direction);
}

Shares d_infinity_shares(float direction) {
  Shares shares{};
  if (direction < 0) return shares;
  const int first = static_cast<int>(direction);
  const double beyond = static_cast<double>(direction) - first;
  shares[at(first & 7)] = 1 - beyond;
  shares[at((first + 1) & 7)] = beyond;
  return shares;
}

Shares multiple_flow_shares(const Grid<float>& height, int i, int j, double exponent) {
  const Place place(height, i, j);
  Shares shares{};
  double steepest = 0;
  for (int d = 0; d < 8; ++d) {
    if (!place.has(d)) continue;
    shares[at(d)] = std::max(0.0, place.fall(d) / flow_distance(d));
    steepest = std::max(steepest, shares[at(d)]);
  }
  if (steepest == 0) return shares;
  double sum = 0;
  for (double& s : shares)
    if (s > 0) sum += s = std::pow(s / steepest, exponent);
  for (double& s : shares) s /= sum;
  return shares;
}

/// Adds up area from the highest samples down, each as soon as all of its donors are done.
/// `shares_of(i, j)` says what its neighbours get.
template <class SharesOf>
Grid<double> accumulate_shares(const Grid<float>& height, double cell, const SharesOf& shares_of,
                               Progress& progress) {
  const int w = height.width();
  const int h = height.height();
  Grid<std::uint8_t> waiting(w, h, 0);
  for (int j = 0; j < h; ++j) {
    for (int i = 0; i < w; ++i) {
      const Shares shares = shares_of(i, j);
      for (int d = 0; d < 8; ++d)
        if (shares[at(d)] > 0) ++waiting(i + flow_dx[at(d)], j + flow_dy[at(d)]);
    }
    progress.advance(0);
  }
  std::vector<int> ready;
  for (int k = 0; k < w * h; ++k)
    if (waiting.values()[at(k)] == 0) ready.push_back(k);
  Grid<double> area(w, h, cell * cell);
  for (int count = 0; !ready.empty(); ++count) {
    const int k = ready.back();
    ready.pop_back();
    const Shares shares = shares_of(k % w, k / w);
    for (int d = 0; d < 8; ++d) {
      if (!(shares[at(d)] > 0)) continue;
      const int n = k + flow_step(d, w);
      area.values()[at(n)] += shares[at(d)] * area.values()[at(k)];
      if (--waiting.values()[at(n)] == 0) ready.push_back(n);
    }
    if (count % 4096 == 0) progress.advance(0);
  }
  return area;
}

}  // namespace

Grid<float> d_infinity_directions(const Grid<float>& height, Progress& progress) {
  Grid<float> out(height.width(), height.height());
  parallel_for(0, height.height(), [&](int j) {
    for (int i = 0; i < height.width(); ++i) out(i, j) = d_infinity_at(height, i, j);
    progress.advance(0);
  });
  return out;
}

Grid<double> d_infinity_area(const Grid<float>& height, double cell, Progress& progress) {
  const Grid<float> direction = d_infinity_directions(height, progress);
  return accumulate_shares(
      height, cell, [&](int i, int j) { return d_infinity_shares(direction(i, j)); }, progress);
}

Grid<double> multiple_flow_area(const Grid<float>& height, double cell, double exponent,
                                Progress& progress) {
  return accumulate_shares(
      height, cell, [&](int i, int j) { return multiple_flow_shares(height, i, j, exponent); },
      progress);
}

}  // namespace wold
