#include "erosion/drainage_depressions.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <queue>
#include <vector>

#include "base/parallel.hpp"
#include "erosion/flow_routing.hpp"

namespace wold {

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

/// A sample with a height, ordered by height, then by place: one integer.
class Shore {
 public:
  Shore(float height, int place)
      : key_((static_cast<std::uint64_t>(ordered(height)) << 32U) |
             static_cast<std::uint32_t>(place)) {}
  int place() const { return static_cast<int>(key_ & 0xffffffffU); }
  friend bool operator>(const Shore& a, const Shore& b) { return a.key_ > b.key_; }

 private:
  /// Bits that are ordered as the floats are.
  static std::uint32_t ordered(float x) {
    const auto bits = std::bit_cast<std::uint32_t>(x + 0.0F);  // -0 becomes 0
    return (bits & 0x80000000U) != 0 ? ~bits : bits | 0x80000000U;
  }
  std::uint64_t key_;
};

using ShoreQueue = std::priority_queue<Shore, std::vector<Shore>, std::greater<>>;

bool on_border(int i, int j, int width, int height) {
  return i == 0 || j == 0 || i == width - 1 || j == height - 1;
}

/// Calls `visit(n, d)` for each neighbour n of sample k, in direction d.
template <class Visit>
void each_neighbour(int k, int width, int height, const Visit& visit) {
  const int i = k % width;
  const int j = k / width;
  for (int d = 0; d < 8; ++d) {
    const int x = i + flow_dx[static_cast<std::size_t>(d)];
    const int y = j + flow_dy[static_cast<std::size_t>(d)];
    if (x >= 0 && y >= 0 && x < width && y < height) visit(y * width + x, d);
  }
}

class Flood {
 public:
  Flood(const Grid<float>& height, FillSurface surface)
      : level_(height),
        seen_(height.width(), height.height(), 0),
        width_(height.width()),
        height_(height.height()),
        surface_(surface) {}

  Grid<float> run(Progress& progress) {
    seed_border();
    for (int count = 0; !shores_.empty() || head_ < raised_.size(); ++count) {
      spread(next());
      if (count % 4096 == 0) progress.advance(0);
    }
    return std::move(level_);
  }

 private:
  float& level(int k) { return level_.values()[static_cast<std::size_t>(k)]; }
  std::uint8_t& seen(int k) { return seen_.values()[static_cast<std::size_t>(k)]; }

  void seed_border() {
    for (int j = 0; j < height_; ++j)
      for (int i = 0; i < width_; i += (j == 0 || j == height_ - 1) ? 1 : width_ - 1) {
        seen_(i, j) = 1;
        shores_.emplace(level_(i, j), j * width_ + i);
      }
  }

  /// The lower head of the two queues.
  int next() {
    if (head_ < raised_.size() &&
        (shores_.empty() || level(raised_[head_]) < level(shores_.top().place()))) {
      const int k = raised_[head_++];
      if (head_ == raised_.size()) {
        raised_.clear();
        head_ = 0;
      }
      return k;
    }
    const int k = shores_.top().place();
    shores_.pop();
    return k;
  }

  void spread(int k) {
    const float least =
        surface_ == FillSurface::level ? level(k) : std::nextafter(level(k), infinity);
    each_neighbour(k, width_, height_, [&](int n, int) {
      if (seen(n) != 0) return;
      seen(n) = 1;
      if (level(n) <= least) {
        level(n) = least;
        raised_.push_back(n);
      } else {
        shores_.emplace(level(n), n);
      }
    });
  }

  Grid<float> level_;
  Grid<std::uint8_t> seen_;
  ShoreQueue shores_;
  std::vector<int> raised_;  // from head_ on, in order of level
  std::size_t head_ = 0;
  int width_;
  int height_;
  FillSurface surface_;
};

bool is_pit(const Grid<float>& height, int i, int j) {
  if (on_border(i, j, height.width(), height.height())) return false;
  for (int d = 0; d < 8; ++d)
    if (height(i + flow_dx[static_cast<std::size_t>(d)], j + flow_dy[static_cast<std::size_t>(d)]) <
        height(i, j))
      return false;
  return true;
}

/// Digs one notch after another into a copy of the ground.
class Breacher {
 public:
  Breacher(const Grid<float>& height, double cell, const BreachLimits& limits)
      : ground_(height),
        visit_(height.width(), height.height(), 0),
        cost_(height.width(), height.height(), 0),
        back_(height.width(), height.height(), 0),
        handled_(height.width(), height.height(), 0),
        width_(height.width()),
        height_(height.height()),
        depth_(limits.depth),
        length_(limits.length / cell) {}

  Grid<float> run(Progress& progress) {
    std::vector<Shore> pits;
    for (int j = 0; j < height_; ++j)
      for (int i = 0; i < width_; ++i)
        if (is_pit(ground_, i, j)) pits.emplace_back(ground_(i, j), j * width_ + i);
    std::sort(pits.begin(), pits.end(), [](const Shore& a, const Shore& b) { return b > a; });
    for (const Shore& pit : pits) {
      progress.advance(0);
      const int k = pit.place();
      if (handled_.values()[at(k)] == 0 && is_pit(ground_, k % width_, k / width_))
        breach(k, progress);
    }
    return std::move(ground_);
  }

 private:
  static std::size_t at(int k) { return static_cast<std::size_t>(k); }
  float ground(int k) const { return ground_.values()[at(k)]; }

  /// Searches outwards from the pit by what must be dug, and digs along the way found.
  void breach(int pit, Progress& progress) {
    ++stamp_;
    ShoreQueue front;
    front.emplace(0.0F, pit);
    reach(pit, 0, 0);
    for (int count = 0; !front.empty(); ++count) {
      const int k = front.top().place();
      front.pop();
      if (visit_.values()[at(k)] == -stamp_) continue;  // was in the queue at a greater cost
      visit_.values()[at(k)] = -stamp_;
      if (leads_out(k, pit)) {
        dig(k, pit);
        return;
      }
      if (ground(k) == ground(pit)) handled_.values()[at(k)] = 1;  // one notch drains a flat
      extend(k, pit, front);
      if (count % 1024 == 0) progress.advance(0);
    }
  }

  bool leads_out(int k, int pit) const {
    return ground(k) < ground(pit) || on_border(k % width_, k / width_, width_, height_);
  }

  void reach(int k, float cost, int back) {
    visit_.values()[at(k)] = stamp_;
    cost_.values()[at(k)] = cost;
    back_.values()[at(k)] = static_cast<std::uint8_t>(back);
  }

  void extend(int k, int pit, ShoreQueue& front) {
    each_neighbour(k, width_, height_, [&](int n, int d) {
      const int visit = visit_.values()[at(n)];
      if (visit == -stamp_) return;
      const float depth = std::max(0.0F, ground(n) - ground(pit));
      const double away = std::hypot(n % width_ - pit % width_, n / width_ - pit / width_);
      if (static_cast<double>(depth) > depth_ || away > length_) return;
      const float cost = cost_.values()[at(k)] + depth * static_cast<float>(flow_distance(d));
      if (visit == stamp_ && cost_.values()[at(n)] <= cost) return;
      reach(n, cost, opposite_flow(d));
      front.emplace(cost, n);
    });
  }

  /// From the way out back to the pit the ground falls towards the way out.
  void dig(int out, int pit) {
    std::vector<int> path;
    for (int k = out; k != pit; k += flow_step(back_.values()[at(k)], width_)) path.push_back(k);
    float bed = ground(pit);
    for (auto k = path.rbegin(); k != path.rend(); ++k) {
      bed = std::nextafter(bed, -infinity);
      float& h = ground_.values()[at(*k)];
      h = std::min(h, bed);
      bed = h;
    }
  }

  Grid<float> ground_;
  Grid<int> visit_;  // stamp_: reached in this search; -stamp_: done
  Grid<float> cost_;
  Grid<std::uint8_t> back_;
  Grid<std::uint8_t> handled_;
  int stamp_ = 0;
  int width_;
  int height_;
  double depth_;   // m
  double length_;  // cells
};

}  // namespace

Grid<float> fill_depressions(const Grid<float>& height, FillSurface surface, Progress& progress) {
  return Flood(height, surface).run(progress);
}

Grid<float> breach_depressions(const Grid<float>& height, double cell, const BreachLimits& limits,
                               Progress& progress) {
  return Breacher(height, cell, limits).run(progress);
}

int count_pits(const Grid<float>& height) {
  return parallel_reduce(
      0, height.height(), 0,
      [&](int j) {
        int count = 0;
        for (int i = 0; i < height.width(); ++i) count += is_pit(height, i, j) ? 1 : 0;
        return count;
      },
      [](int a, int b) { return a + b; });
}

}  // namespace wold
