#include "erosion/drainage_network.hpp"

#include <algorithm>

#include "base/vec.hpp"

namespace wold {

namespace {

std::size_t at(int k) {
  return static_cast<std::size_t>(k);
}

/// The order of a channel whose highest donor has order `highest`, `count` times.
int joined_order(int highest, int count) {
  if (highest == 0) return 1;
  return count > 1 ? highest + 1 : highest;
}

/// Collects a lake from one of its samples.
class LakeFinder {
 public:
  LakeFinder(const Grid<float>& height, const Grid<float>& filled, double cell)
      : height_(height), filled_(filled), cell_area_(cell * cell) {
    found_.label = Grid<std::int32_t>(height.width(), height.height(), 0);
  }

  Lakes run() {
    for (int j = 0; j < height_.height(); ++j)
      for (int i = 0; i < height_.width(); ++i)
        if (is_water(i, j) && found_.label(i, j) == 0) collect(i, j);
    return std::move(found_);
  }

 private:
  bool is_water(int i, int j) const { return filled_(i, j) > height_(i, j); }

  void collect(int i, int j) {
    Lake lake{filled_(i, j)};
    const auto label = static_cast<std::int32_t>(found_.lakes.size() + 1);
    std::vector<IVec2> open{{i, j}};
    found_.label(i, j) = label;
    while (!open.empty()) {
      const IVec2 p = open.back();
      open.pop_back();
      const float depth = filled_(p.x, p.y) - height_(p.x, p.y);
      lake.area += cell_area_;
      lake.volume += static_cast<double>(depth) * cell_area_;
      lake.depth = std::max(lake.depth, depth);
      spread(p, lake.level, label, open);
    }
    found_.lakes.push_back(lake);
  }

  void spread(IVec2 p, float level, std::int32_t label, std::vector<IVec2>& open) {
    for (std::size_t d = 0; d < 8; ++d) {
      const IVec2 n{p.x + flow_dx[d], p.y + flow_dy[d]};
      if (n.x < 0 || n.y < 0 || n.x >= height_.width() || n.y >= height_.height()) continue;
      if (!is_water(n.x, n.y) || filled_(n.x, n.y) != level || found_.label(n.x, n.y) != 0)
        continue;
      found_.label(n.x, n.y) = label;
      open.push_back(n);
    }
  }

  const Grid<float>& height_;
  const Grid<float>& filled_;
  double cell_area_;
  Lakes found_;
};

}  // namespace

Grid<std::int32_t> basin_labels(const Grid<std::uint8_t>& direction, const FlowOrder& order) {
  Grid<std::int32_t> label(direction.width(), direction.height());
  const std::span<std::int32_t> out = label.values();
  std::int32_t basins = 0;
  for (std::size_t k = 0; k < out.size(); ++k)
    if (direction.values()[k] >= flow_stops) out[k] = ++basins;
  order.downstream_first([&](int k) {
    const int d = direction.values()[at(k)];
    if (d < flow_stops) out[at(k)] = out[at(k + flow_step(d, direction.width()))];
  });
  return label;
}

Grid<std::uint8_t> strahler_order(const Grid<std::uint8_t>& direction, const FlowOrder& order,
                                  const Grid<double>& area, double channel_area) {
  Grid<std::uint8_t> strahler(direction.width(), direction.height(), 0);
  const std::span<std::uint8_t> out = strahler.values();
  order.upstream_first([&](int k) {
    if (area.values()[at(k)] < channel_area) return;
    int highest = 0;
    int count = 0;
    each_donor(direction, k, [&](int n) {
      const int o = out[at(n)];
      if (o == highest) ++count;
      if (o > highest) {
        highest = o;
        count = 1;
      }
    });
    out[at(k)] = static_cast<std::uint8_t>(joined_order(highest, count));
  });
  return strahler;
}

Grid<float> downstream_length(const Grid<std::uint8_t>& direction, const FlowOrder& order,
                              double cell) {
  Grid<double> length(direction.width(), direction.height(), 0);
  const std::span<double> l = length.values();
  order.downstream_first([&](int k) {
    const int d = direction.values()[at(k)];
    if (d < flow_stops)
      l[at(k)] = l[at(k + flow_step(d, direction.width()))] + cell * flow_distance(d);
  });
  Grid<float> out(direction.width(), direction.height());
  std::transform(l.begin(), l.end(), out.values().begin(),
                 [](double x) { return static_cast<float>(x); });
  return out;
}

Grid<float> upstream_length(const Grid<std::uint8_t>& direction, const FlowOrder& order,
                            double cell) {
  Grid<float> length(direction.width(), direction.height(), 0);
  const std::span<float> out = length.values();
  order.upstream_first([&](int k) {
    each_donor(direction, k, [&](int n) {
      const double step = cell * flow_distance(direction.values()[at(n)]);
      out[at(k)] = std::max(out[at(k)], out[at(n)] + static_cast<float>(step));
    });
  });
  return length;
}

Lakes find_lakes(const Grid<float>& height, const Grid<float>& filled, double cell) {
  return LakeFinder(height, filled, cell).run();
}

}  // namespace wold
