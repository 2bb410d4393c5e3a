#include "forest/spacing.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/hash.hpp"
#include "base/vec.hpp"
#include "forest/disc_field.hpp"

namespace wold {

namespace {

constexpr int rough_plants = 2500;  // in the patch on which candidates are found roughly
constexpr int fine_plants = 12000;  // and then finely

/// A candidate, or a probe that only asks whether there would be room.
struct Item {
  DVec2 place{0};
  std::uint32_t order = 0;
  std::uint16_t kind = 0;
  bool probe = false;
};

class Patch {
 public:
  Patch(const SpacingPlan& plan, double side, int probes)
      : plan_(plan), side_(side), probes_(probes) {}

  /// The chance of each kind to find room when candidates fall as `density` says.
  std::vector<double> chances(std::span<const double> density) {
    std::vector<Item> items;
    for (std::size_t kind = 0; kind < density.size(); ++kind) {
      drop_candidates(items, kind, static_cast<int>(std::lround(density[kind] * side_ * side_)));
      if (few(density[kind])) drop_probes(items, kind);
    }
    std::sort(items.begin(), items.end(), [&](const Item& a, const Item& b) {
      const int class_a = plan_.kinds[a.kind].size_class;
      const int class_b = plan_.kinds[b.kind].size_class;
      return class_a != class_b ? class_a < class_b : a.order < b.order;
    });
    DiscField field(DVec2(0), DVec2(side_), plan_.class_radius);
    std::vector<double> room(density.size());
    std::vector<double> probes(density.size());
    const double margin = std::min(4.0 * static_cast<double>(plan_.class_radius[0]), 0.3 * side_);
    for (const Item& item : items) {
      const DiscKind& kind = plan_.kinds[item.kind];
      const bool free = field.test(item.place, kind.radius, kind.size_class) == DiscFit::free;
      if (free && !item.probe) field.add(item.place, kind.radius, kind.size_class, true);
      const DVec2 p = item.place;
      if (std::min({p.x, p.y, side_ - p.x, side_ - p.y}) < margin) continue;
      probes[item.kind] += item.probe ? 1 : 0;
      room[item.kind] += free && item.probe == few(density[item.kind]) ? 1 : 0;
    }
    const double area = (side_ - 2 * margin) * (side_ - 2 * margin);
    for (std::size_t kind = 0; kind < room.size(); ++kind) {
      const double asked = few(density[kind]) ? probes[kind] : density[kind] * area;
      room[kind] = std::max(room[kind], 0.5) / std::max(asked, 1.0);
    }
    return room;
  }

 private:
  /// Whether probes tell the chance of a kind better than its own few candidates.
  bool few(double density) const { return density * side_ * side_ < 1500; }

  void drop_candidates(std::vector<Item>& items, std::size_t kind, int count) const {
    constexpr std::uint64_t seed = 0x5ca77e2;
    for (int n = 0; n < count; ++n) {
      const std::uint64_t key = random_bits(seed, kind, n);
      const DVec2 place{uniform_double(random_bits(key, 0)), uniform_double(random_bits(key, 1))};
      items.push_back({side_ * place, static_cast<std::uint32_t>(key >> 32U),
                       static_cast<std::uint16_t>(kind), false});
    }
  }

  /// Evenly over places and orders: the additive recurrence R3 (Roberts 2018) on powers of 1
  /// / 1.2207.
  void drop_probes(std::vector<Item>& items, std::size_t kind) const {
    const auto part = [](double n, double step) { return n * step - std::floor(n * step); };
    for (int k = 0; k < probes_; ++k) {
      const double n = k + 0.5;
      const DVec2 place{part(n, 0.8191725133961645), part(n, 0.6710436067037893)};
      items.push_back({side_ * place,
                       static_cast<std::uint32_t>(part(n, 0.5497004779019703) * 0x1p32),
                       static_cast<std::uint16_t>(kind), true});
    }
  }

  const SpacingPlan& plan_;
  double side_;
  int probes_;
};

void set_classes(SpacingPlan& plan) {
  float largest = 0;
  for (const DiscKind& kind : plan.kinds)
    if (kind.wished > 0) largest = std::max(largest, kind.radius);
  for (DiscKind& kind : plan.kinds) {
    if (!(kind.wished > 0)) continue;
    kind.size_class = std::min(static_cast<int>(std::log2(largest / kind.radius) + 1e-6F), 20);
    if (plan.class_radius.size() <= static_cast<std::size_t>(kind.size_class))
      plan.class_radius.resize(static_cast<std::size_t>(kind.size_class) + 1);
  }
  for (std::size_t k = 0; k < plan.class_radius.size(); ++k)
    plan.class_radius[k] = std::ldexp(largest, -static_cast<int>(k));
}

/// Densities of candidates that give the wished densities times `part`, from a first guess.
std::vector<double> solve(const SpacingPlan& plan, Patch& patch, double part,
                          std::vector<double> candidates, int rounds) {
  // Crowding makes the plain step too short: with e = d log(reached) / d log(candidates), in (0,
  // 1], the error shrinks by 1 - step · e each round.
  constexpr double step = 1.6;
  for (int round = 0; round < rounds; ++round) {
    const std::vector<double> chance = patch.chances(candidates);
    for (std::size_t k = 0; k < candidates.size(); ++k) {
      const double wished = part * plan.kinds[k].wished;
      if (!(wished > 0)) continue;
      const double ratio = wished / (chance[k] * candidates[k]);
      candidates[k] =
          std::clamp(candidates[k] * std::pow(ratio, step), wished, most_candidates * wished);
    }
  }
  return candidates;
}

}  // namespace

double DiscKind::share_for(double part) const {
  const double p = std::clamp(part, 0.0, 1.0);
  const auto k = static_cast<std::size_t>(std::min(static_cast<int>(4 * p), 3));
  const double along = 4 * p - static_cast<double>(k);
  return p * (crowding[k] + along * (crowding[k + 1] - crowding[k]));
}

double SpacingPlan::reached() const {
  double sum = 0;
  for (const DiscKind& kind : kinds) sum += kind.reached;
  return sum;
}

double jamming_distance(double density) {
  return std::sqrt(4 * jamming_coverage / (pi_d * density));
}

SpacingPlan plan_spacing(std::span<const float> radius, std::span<const double> density) {
  SpacingPlan plan;
  double wished = 0;
  for (std::size_t k = 0; k < radius.size(); ++k) {
    DiscKind kind;
    kind.radius = radius[k];
    kind.wished = density[k];
    plan.kinds.push_back(kind);
    wished += density[k];
  }
  if (!(wished > 0)) return plan;
  set_classes(plan);
  // Wide enough for the largest discs to have neighbours and not only borders.
  const auto side = [&](int plants) {
    const double plain = std::sqrt(plants / wished);
    return std::clamp(12.0 * static_cast<double>(plan.class_radius[0]), plain, 4 * plain);
  };
  Patch rough(plan, side(rough_plants), 3000);
  std::vector<double> guess;
  for (const DiscKind& kind : plan.kinds) guess.push_back(kind.wished);
  const std::vector<double> full = solve(plan, rough, 1, guess, 9);
  for (std::size_t k = 0; k < full.size(); ++k) {
    DiscKind& kind = plan.kinds[k];
    if (!(kind.wished > 0)) continue;
    kind.crowding[0] = kind.wished / full[k];  // nothing in the way: one candidate per plant
    kind.crowding[4] = 1;
  }
  for (std::size_t quarter = 1; quarter < 4; ++quarter) {
    const double part = 0.25 * static_cast<double>(quarter);
    for (std::size_t k = 0; k < guess.size(); ++k) guess[k] = part * plan.kinds[k].wished;
    const std::vector<double> fewer = solve(plan, rough, part, guess, 6);
    for (std::size_t k = 0; k < full.size(); ++k)
      if (full[k] > 0) plan.kinds[k].crowding[quarter] = std::min(1.0, fewer[k] / (part * full[k]));
  }
  Patch fine(plan, side(fine_plants), 12000);
  const std::vector<double> candidates = solve(plan, fine, 1, full, 3);
  const std::vector<double> chance = fine.chances(candidates);
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    plan.kinds[k].candidates = candidates[k];
    plan.kinds[k].reached = candidates[k] * chance[k];
    plan.candidates += candidates[k];
  }
  return plan;
}

}  // namespace wold
