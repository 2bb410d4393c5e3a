#include "erosion/flow_routing.hpp"

#include <algorithm>
#include <bit>

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

/// Sets bit d where `from` flows the opposite way. In blocks, as bytes that may alias forbid
/// vectors.
void mark_donors(const std::uint8_t* from, std::uint8_t* out, int d, int count) {
  constexpr int block = 64;
  const auto towards = static_cast<std::uint8_t>(opposite_flow(d));
  const auto bit = static_cast<std::uint8_t>(1U << static_cast<unsigned>(d));
  const auto marked = [=](std::uint8_t mask, std::uint8_t direction) {
    return static_cast<std::uint8_t>(mask | (direction == towards ? bit : 0));
  };
  int i = 0;
  for (; i + block <= count; i += block) {
    std::array<std::uint8_t, block> masks;
    for (int k = 0; k < block; ++k)
      masks[static_cast<std::size_t>(k)] = marked(out[i + k], from[i + k]);
    std::copy(masks.begin(), masks.end(), out + i);
  }
  for (; i < count; ++i) out[i] = marked(out[i], from[i]);
}

/// What flows out of a band of rows.
template <class Amount>
struct Crossing {
  int receiver = 0;
  Amount amount = 0;
};

/// Walks downstream, and adds up amounts.
template <class Amount>
class Walker {
 public:
  Walker(const Grid<std::uint8_t>& direction, std::span<std::uint8_t> waiting,
         std::span<Amount> amounts)
      : direction_(direction.values().data()), waiting_(waiting.data()), amounts_(amounts.data()) {
    for (int d = 0; d < 8; ++d)
      step_[static_cast<std::size_t>(d)] = flow_step(d, direction.width());
  }

  /// From k, whose donors are all done, on as long as no other donor is missing. What leaves the
  /// samples [first, last) is put aside.
  void walk(int k, int first, int last, std::vector<int>& nodes,
            std::vector<Crossing<Amount>>& outside) const {
    for (;;) {
      nodes.push_back(k);
      const int d = direction_[k];
      if (d >= flow_stops) return;
      const int receiver = k + step_[static_cast<std::size_t>(d)];
      if (receiver < first || receiver >= last) {
        outside.push_back({receiver, amounts_[k]});
        return;
      }
      amounts_[receiver] += amounts_[k];
      if (--waiting_[receiver] != 0) return;
      k = receiver;
    }
  }

 private:
  const std::uint8_t* direction_;
  std::uint8_t* waiting_;
  Amount* amounts_;
  std::array<int, 8> step_{};
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
        progress.advance(0);
      },
      8);
  return out;
}

void donor_masks(const Grid<std::uint8_t>& direction, Grid<std::uint8_t>& mask,
                 Progress& progress) {
  const int w = direction.width();
  if (!mask.same_shape(direction)) mask = Grid<std::uint8_t>(w, direction.height());
  parallel_for(
      0, direction.height(),
      [&](int j) {
        const std::span<std::uint8_t> out = mask.row(j);
        std::fill(out.begin(), out.end(), std::uint8_t{0});
        for (int d = 0; d < 8; ++d) {
          const int y = j + flow_dy[static_cast<std::size_t>(d)];
          if (y < 0 || y >= direction.height()) continue;
          const int dx = flow_dx[static_cast<std::size_t>(d)];
          const int first = std::max(0, -dx);
          mark_donors(direction.row(y).data() + first + dx, out.data() + first, d,
                      std::min(w, w - dx) - first);
        }
        progress.advance(0);
      },
      8);
}

template <class Amount>
void FlowOrder::build_with(const Grid<std::uint8_t>& direction, std::span<Amount> amounts,
                           Progress& progress) {
  const int w = direction.width();
  const int h = direction.height();
  donor_masks(direction, donors_, progress);
  if (!waiting_.same_shape(donors_)) waiting_ = Grid<std::uint8_t>(w, h);
  const Walker<Amount> walker(direction, waiting_.values(), amounts);
  bands_.resize(static_cast<std::size_t>((h + band_rows - 1) / band_rows));
  std::vector<std::vector<Crossing<Amount>>> outside(bands_.size());
  parallel_for(0, bands(), [&](int b) {
    const auto band = static_cast<std::size_t>(b);
    const int first = b * band_rows * w;
    const int last = std::min(h, (b + 1) * band_rows) * w;
    for (int k = first; k < last; ++k)
      waiting_.values()[static_cast<std::size_t>(k)] =
          static_cast<std::uint8_t>(std::popcount(donors_.values()[static_cast<std::size_t>(k)]));
    bands_[band].clear();
    bands_[band].reserve(static_cast<std::size_t>(last - first));
    for (int k = first; k < last; ++k) {
      if (donors_.values()[static_cast<std::size_t>(k)] == 0)
        walker.walk(k, first, last, bands_[band], outside[band]);
      if (k % w == 0) progress.advance(0);
    }
  });
  trunk_.clear();
  std::vector<Crossing<Amount>> nowhere;
  for (const std::vector<Crossing<Amount>>& crossings : outside) {
    for (const Crossing<Amount>& c : crossings) {
      amounts[static_cast<std::size_t>(c.receiver)] += c.amount;
      if (--waiting_.values()[static_cast<std::size_t>(c.receiver)] == 0)
        walker.walk(c.receiver, 0, w * h, trunk_, nowhere);
    }
    progress.advance(0);
  }
}

void FlowOrder::build(const Grid<std::uint8_t>& direction, std::span<std::int32_t> amounts,
                      Progress& progress) {
  build_with(direction, amounts, progress);
}

void FlowOrder::build(const Grid<std::uint8_t>& direction, std::span<std::int64_t> amounts,
                      Progress& progress) {
  build_with(direction, amounts, progress);
}

FlowOrder::FlowOrder(const Grid<std::uint8_t>& direction, Progress& progress) {
  std::vector<std::int32_t> none(direction.size());
  build(direction, none, progress);
}

Grid<double> d8_area(const Grid<std::uint8_t>& direction, const FlowOrder& order, double cell) {
  return accumulate_flow(direction, order, [area = cell * cell](int) { return area; });
}

}  // namespace wold
