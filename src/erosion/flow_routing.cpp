#include "erosion/flow_routing.hpp"

#include <algorithm>

namespace wold {

namespace {

/// Rows per band: enough bands for many threads, few enough that the trunk stays short.
constexpr int band_rows = 128;

/// The D8 direction of one sample that may lie on the border.
std::uint8_t direction_at(const Grid<float>& height, int i, int j) {
  const int w = height.width();
  const int h = height.height();
  float steepest = 0;
  const bool on_border = i == 0 || j == 0 || i == w - 1 || j == h - 1;
  std::uint8_t direction = on_border ? flow_leaves : flow_stops;
  for (int d = 0; d < 8; ++d) {
    const int x = i + flow_dx[static_cast<std::size_t>(d)];
    const int y = j + flow_dy[static_cast<std::size_t>(d)];
    if (x < 0 || y < 0 || x >= w || y >= h) continue;
    const float slope = (height(i, j) - height(x, y)) * static_cast<float>(1 / flow_distance(d));
    if (slope > steepest) {
      steepest = slope;
      direction = static_cast<std::uint8_t>(d);
    }
  }
  return direction;
}

/// The inner samples of a row; plain selects, so that the compiler makes vectors of it.
void directions_of_row(const Grid<float>& height, int j, std::span<int> direction) {
  const int w = height.width();
  const float* h = &height(0, j);
  for (int i = 1; i < w - 1; ++i) {
    float steepest = 0;
    int best = flow_stops;
    for (int d = 0; d < 8; ++d) {
      const float slope =
          (h[i] - h[i + flow_step(d, w)]) * static_cast<float>(1 / flow_distance(d));
      best = slope > steepest ? d : best;
      steepest = slope > steepest ? slope : steepest;
    }
    direction[static_cast<std::size_t>(i)] = best;
  }
}

/// Walks downstream through the band of samples [first, last) and beyond its border if there is
/// none.
class Walker {
 public:
  Walker(const Grid<std::uint8_t>& direction, std::span<std::uint8_t> waiting)
      : direction_(direction.values()), waiting_(waiting), width_(direction.width()) {}

  /// From k, whose donors are all done. What would be next but lies outside the band is put aside.
  void walk(int k, int first, int last, std::vector<int>& nodes, std::vector<int>& outside) const {
    for (;;) {
      nodes.push_back(k);
      const int d = direction_[static_cast<std::size_t>(k)];
      if (d >= flow_stops) return;
      const int receiver = k + flow_step(d, width_);
      if (receiver < first || receiver >= last) {
        outside.push_back(receiver);
        return;
      }
      if (--waiting_[static_cast<std::size_t>(receiver)] != 0) return;
      k = receiver;
    }
  }

 private:
  std::span<const std::uint8_t> direction_;
  std::span<std::uint8_t> waiting_;
  int width_;
};

}  // namespace

Grid<std::uint8_t> d8_directions(const Grid<float>& height, Progress& progress) {
  const int w = height.width();
  const int h = height.height();
  Grid<std::uint8_t> out(w, h);
  parallel_for(
      0, h,
      [&](int j) {
        const std::span<std::uint8_t> row = out.row(j);
        if (j == 0 || j == h - 1) {
          for (int i = 0; i < w; ++i) row[static_cast<std::size_t>(i)] = direction_at(height, i, j);
        } else {
          std::vector<int> inner(static_cast<std::size_t>(w));
          directions_of_row(height, j, inner);
          std::transform(inner.begin(), inner.end(), row.begin(),
                         [](int d) { return static_cast<std::uint8_t>(d); });
          row.front() = direction_at(height, 0, j);
          row.back() = direction_at(height, w - 1, j);
        }
        progress.check();
      },
      8);
  return out;
}

Grid<std::uint8_t> donor_counts(const Grid<std::uint8_t>& direction, Progress& progress) {
  const int w = direction.width();
  Grid<std::uint8_t> count(w, direction.height());
  parallel_for(
      0, direction.height(),
      [&](int j) {
        const std::span<std::uint8_t> out = count.row(j);
        for (int d = 0; d < 8; ++d) {
          const int y = j + flow_dy[static_cast<std::size_t>(d)];
          if (y < 0 || y >= direction.height()) continue;
          const int dx = flow_dx[static_cast<std::size_t>(d)];
          const std::uint8_t* from = direction.row(y).data();
          const auto towards_me = static_cast<std::uint8_t>(opposite_flow(d));
          for (int i = std::max(0, -dx); i < std::min(w, w - dx); ++i)
            out[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(
                out[static_cast<std::size_t>(i)] + (from[i + dx] == towards_me ? 1 : 0));
        }
        progress.check();
      },
      8);
  return count;
}

FlowOrder::FlowOrder(const Grid<std::uint8_t>& direction, Progress& progress) {
  const int w = direction.width();
  const int h = direction.height();
  const Grid<std::uint8_t> donors = donor_counts(direction, progress);
  Grid<std::uint8_t> waiting = donors;
  const Walker walker(direction, waiting.values());
  bands_.resize(static_cast<std::size_t>((h + band_rows - 1) / band_rows));
  std::vector<std::vector<int>> outside(bands_.size());
  parallel_for(0, bands(), [&](int b) {
    const auto band = static_cast<std::size_t>(b);
    const int first = b * band_rows * w;
    const int last = std::min(h, (b + 1) * band_rows) * w;
    bands_[band].reserve(static_cast<std::size_t>(last - first));
    for (int k = first; k < last; ++k) {
      if (donors.values()[static_cast<std::size_t>(k)] == 0)
        walker.walk(k, first, last, bands_[band], outside[band]);
      if (k % w == 0) progress.check();
    }
  });
  std::vector<int> nowhere;
  for (const std::vector<int>& receivers : outside)
    for (const int k : receivers)
      if (--waiting.values()[static_cast<std::size_t>(k)] == 0)
        walker.walk(k, 0, w * h, trunk_, nowhere);
}

Grid<double> d8_area(const Grid<std::uint8_t>& direction, const FlowOrder& order, double cell) {
  return accumulate_flow(direction, order, [area = cell * cell](int) { return area; });
}

}  // namespace wold
