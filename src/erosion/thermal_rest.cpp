#include "erosion/thermal_rest.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>
#include <tuple>
#include <utility>
#include <vector>

#include "base/parallel.hpp"
#include "base/vec.hpp"
#include "erosion/thermal_pass.hpp"

namespace wold {

namespace {

/// As thick as films are: this part of the largest drop between neighbours.
constexpr int films_of_a_drop = 64;
constexpr int samples_between_checks = 4096;

struct Neighbour {
  int i, j;
  bool diagonal;
};
constexpr std::array<Neighbour, 8> neighbours{{{-1, -1, true},
                                               {0, -1, false},
                                               {1, -1, true},
                                               {-1, 0, false},
                                               {1, 0, false},
                                               {-1, 1, true},
                                               {0, 1, false},
                                               {1, 1, true}}};

/// Largest differences of height, units.
struct Drops {
  std::int32_t straight = 0;
  std::int32_t diagonal = 0;
};

class Settling {
 public:
  Settling(SlideGround& ground, const SlideRules& rules, Progress& progress)
      : ground_(ground),
        rules_(rules),
        lies_(drops(rules.repose + rules.tolerance)),
        stops_(drops(stop_angle(rules.repose, rules))),
        progress_(progress),
        load_(ground.surface.width(), ground.surface.height()),
        waits_(ground.surface.width(), ground.surface.height()) {}

  void run() {
    cut();
    pour();
  }

 private:
  static double stop_angle(double repose, const SlideRules& rules) {
    return std::max(repose - 2 * rules.tolerance, repose / 2);
  }
  Drops drops(double angle) const {
    const double cell = ground_.cell / ground_.unit;
    const auto straight = std::sqrt(static_cast<double>(slide_step(angle, cell)));
    const auto whole = [](double drop) {
      return static_cast<std::int32_t>(std::clamp(drop, 1.0, static_cast<double>(slide_range)));
    };
    return {whole(straight), whole(straight * std::sqrt(2.0))};
  }
  /// The angle of repose at a sample, degrees.
  double repose(int i, int j) const {
    return rules_.repose + static_cast<double>(ground_.hardness(i, j)) * (90 - rules_.repose);
  }
  bool alike() const { return ground_.hardness.empty() || !ground_.bed.empty(); }
  Drops lies_at(int i, int j) const {
    return alike() ? lies_ : drops(repose(i, j) + rules_.tolerance);
  }
  Drops stops_at(int i, int j) const {
    return alike() ? stops_ : drops(stop_angle(repose(i, j), rules_));
  }

  bool inside(int i, int j) const {
    return i >= 0 && j >= 0 && i < load_.width() && j < load_.height();
  }
  template <class Function>
  void around(int i, int j, const Function& function) const {
    for (const Neighbour& n : neighbours)
      if (inside(i + n.i, j + n.j)) function(i + n.i, j + n.j, n.diagonal);
  }

  /// The highest that (i, j) may be above its neighbours.
  std::int32_t highest(int i, int j, const Drops& drops) const {
    std::int32_t out = 2 * slide_range;
    around(i, j, [&](int m, int n, bool diagonal) {
      out = std::min(out, ground_.surface(m, n) + (diagonal ? drops.diagonal : drops.straight));
    });
    return out;
  }
  /// The height that (i, j) is cut down to.
  std::int32_t cut_height(int i, int j) const {
    const std::int32_t here = ground_.surface(i, j);
    const bool bedded = !ground_.bed.empty();
    if (bedded && ground_.bed(i, j) == here) return here;
    const std::int32_t most = highest(i, j, lies_at(i, j));
    return std::min(here, bedded ? std::max(most, ground_.bed(i, j)) : most);
  }

  void check_now_and_then() {
    if (++samples_ % samples_between_checks == 0) progress_.advance(0);
  }

  std::queue<IVec2> too_steep() const {
    std::vector<std::vector<int>> found(static_cast<std::size_t>(ground_.surface.height()));
    parallel_for(0, ground_.surface.height(), [&](int j) {
      progress_.advance(0);
      for (int i = 0; i < ground_.surface.width(); ++i)
        if (cut_height(i, j) < ground_.surface(i, j))
          found[static_cast<std::size_t>(j)].push_back(i);
    });
    std::queue<IVec2> out;
    for (int j = 0; j < ground_.surface.height(); ++j)
      for (const int i : found[static_cast<std::size_t>(j)]) out.emplace(i, j);
    return out;
  }

  void cut() {
    std::queue<IVec2> waiting = too_steep();
    for (; !waiting.empty(); waiting.pop()) {
      check_now_and_then();
      const auto [i, j] = std::pair(waiting.front().x, waiting.front().y);
      waits_(i, j) = 0;
      const std::int32_t to = cut_height(i, j);
      const std::int32_t from = ground_.surface(i, j);
      if (to == from) continue;
      load_(i, j) += from - to;
      ground_.surface(i, j) = to;
      around(i, j, [&](int m, int n, bool) {
        if (ground_.surface(m, n) <= to || waits_(m, n) != 0) return;
        waits_(m, n) = 1;
        waiting.emplace(m, n);
      });
    }
  }

  struct Waiting {
    std::int32_t height;
    int i, j;
    bool operator<(const Waiting& other) const {
      return std::tie(height, i, j) < std::tie(other.height, other.i, other.j);
    }
  };

  void pour() {
    std::priority_queue<Waiting> waiting;
    for (int j = 0; j < load_.height(); ++j)
      for (int i = 0; i < load_.width(); ++i)
        if (load_(i, j) > 0) waiting.push({ground_.surface(i, j), i, j});
    while (!waiting.empty()) {
      check_now_and_then();
      const Waiting next = waiting.top();
      waiting.pop();
      lay_down(next.i, next.j);
      share_out(next.i, next.j, [&](int m, int n, std::int64_t part) {
        if (load_(m, n) == 0) waiting.push({ground_.surface(m, n), m, n});
        load_(m, n) += part;
      });
    }
  }

  /// Fills what is hollow, and a film more.
  void lay_down(int i, int j) {
    const std::int32_t here = ground_.surface(i, j);
    const Drops stops = stops_at(i, j);
    const std::int32_t room = std::max(0, highest(i, j, stops) - here);
    if (room == 0) return;
    std::int64_t sum = 0;
    std::int64_t count = 0;
    around(i, j, [&](int m, int n, bool) {
      sum += ground_.surface(m, n);
      ++count;
    });
    const std::int64_t hollow = std::max<std::int64_t>(0, sum / count - here);
    const std::int64_t film = stops.straight / films_of_a_drop + 1;
    const auto laid =
        static_cast<std::int32_t>(std::min({load_(i, j), std::int64_t{room}, hollow + film}));
    ground_.surface(i, j) += laid;
    load_(i, j) -= laid;
  }

  /// Hands the load to all lower neighbours.
  template <class Give>
  void share_out(int i, int j, const Give& give) {
    const std::int64_t load = load_(i, j);
    if (load == 0) return;
    load_(i, j) = 0;
    const std::int32_t here = ground_.surface(i, j);
    std::array<double, 8> slopes{};
    double sum = 0;
    std::size_t k = 0;
    std::size_t steepest = 0;
    for (const Neighbour& n : neighbours) {
      if (inside(i + n.i, j + n.j)) {
        const double drop = std::max(0, here - ground_.surface(i + n.i, j + n.j));
        slopes[k] = n.diagonal ? drop / std::sqrt(2.0) : drop;
      }
      sum += slopes[k];
      if (slopes[k] > slopes[steepest]) steepest = k;
      ++k;
    }
    std::int64_t left = load;
    for (k = 0; k < neighbours.size(); ++k) {
      if (k == steepest) continue;
      const auto part = static_cast<std::int64_t>(static_cast<double>(load) * (slopes[k] / sum));
      if (part > 0) give(i + neighbours[k].i, j + neighbours[k].j, part);
      left -= part;
    }
    give(i + neighbours[steepest].i, j + neighbours[steepest].j, left);
  }

  SlideGround& ground_;
  const SlideRules& rules_;
  Drops lies_;   ///< what loose material bears
  Drops stops_;  ///< beneath which it lies down
  Progress& progress_;
  Grid<std::int64_t> load_;  ///< what runs down, units
  Grid<char> waits_;         ///< to be cut
  int samples_ = 0;
};

}  // namespace

void bring_to_rest(SlideGround& ground, const SlideRules& rules, Progress& progress) {
  Settling(ground, rules, progress).run();
}

}  // namespace wold
