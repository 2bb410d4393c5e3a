#include "forest/spacing.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/hash.hpp"
#include "base/vec.hpp"
#include "forest/disc_field.hpp"

namespace wold {

namespace {

constexpr int patch_plants = 2500;
constexpr int probes_per_kind = 1500;

/// A candidate, or a probe that only asks whether there would be room.
struct Item {
  DVec2 place{0};
  std::uint32_t order = 0;
  std::uint16_t kind = 0;
  bool probe = false;
};

class Patch {
 public:
  Patch(const SpacingPlan& plan, double side) : plan_(plan), side_(side) {}

  /// The chance of each kind to find room when candidates fall as `density` says.
  std::vector<double> chances(std::span<const double> density) {
    std::vector<Item> items;
    for (std::size_t kind = 0; kind < density.size(); ++kind) {
      scatter(items, kind, static_cast<int>(density[kind] * side_ * side_ + 0.5), false);
      scatter(items, kind, probes_per_kind, true);
    }
    std::sort(items.begin(), items.end(), [&](const Item& a, const Item& b) {
      const int class_a = plan_.kinds[a.kind].size_class;
      const int class_b = plan_.kinds[b.kind].size_class;
      return class_a != class_b ? class_a < class_b : a.order < b.order;
    });
    DiscField field(DVec2(0), DVec2(side_), plan_.class_radius);
    std::vector<double> room(density.size());
    std::vector<double> asked(density.size());
    const double margin = std::min(2.0 * static_cast<double>(plan_.class_radius[0]), 0.3 * side_);
    for (const Item& item : items) {
      const DiscKind& kind = plan_.kinds[item.kind];
      const bool free = field.test(item.place, kind.radius, kind.size_class) == DiscFit::free;
      if (!item.probe) {
        if (free) field.add(item.place, kind.radius, kind.size_class, true);
        continue;
      }
      const DVec2 p = item.place;
      if (std::min({p.x, p.y, side_ - p.x, side_ - p.y}) < margin) continue;
      asked[item.kind] += 1;
      room[item.kind] += free ? 1 : 0;
    }
    for (std::size_t kind = 0; kind < room.size(); ++kind)
      room[kind] = std::max(room[kind], 0.5) / std::max(asked[kind], 1.0);
    return room;
  }

 private:
  void scatter(std::vector<Item>& items, std::size_t kind, int count, bool probe) const {
    constexpr std::uint64_t seed = 0x5ca77e2;
    for (int n = 0; n < count; ++n) {
      const std::uint64_t key = random_bits(seed, kind, n, probe);
      items.push_back(
          {side_ * DVec2(uniform_double(random_bits(key, 0)), uniform_double(random_bits(key, 1))),
           static_cast<std::uint32_t>(key >> 32U), static_cast<std::uint16_t>(kind), probe});
    }
  }

  const SpacingPlan& plan_;
  double side_;
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

/// Densities of candidates that give the wished densities times `part`.
std::vector<double> solve(const SpacingPlan& plan, Patch& patch, double part, int rounds) {
  std::vector<double> wished;
  for (const DiscKind& kind : plan.kinds) wished.push_back(part * kind.wished);
  std::vector<double> candidates = wished;
  for (int round = 0; round < rounds; ++round) {
    const std::vector<double> chance = patch.chances(candidates);
    for (std::size_t k = 0; k < candidates.size(); ++k) {
      const double goal = std::min(wished[k] / chance[k], most_candidates * wished[k]);
      candidates[k] = round < 2 ? goal : std::sqrt(goal * candidates[k]);
    }
  }
  return candidates;
}

}  // namespace

double DiscKind::share_for(double part) const {
  const double at = std::clamp(part, 0.0, 1.0) * 4;
  const auto k = static_cast<std::size_t>(std::min(static_cast<int>(at), 3));
  return share[k] + (at - static_cast<double>(k)) * (share[k + 1] - share[k]);
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
  const double side = std::max(std::sqrt(patch_plants / wished),
                               std::min(12.0 * static_cast<double>(plan.class_radius[0]),
                                        4 * std::sqrt(patch_plants / wished)));
  Patch patch(plan, side);
  const std::vector<double> full = solve(plan, patch, 1, 8);
  const std::vector<double> chance = patch.chances(full);
  for (std::size_t k = 0; k < full.size(); ++k) {
    plan.kinds[k].candidates = full[k];
    plan.kinds[k].reached = full[k] * chance[k];
    plan.kinds[k].share[4] = 1;
    plan.candidates += full[k];
  }
  for (std::size_t quarter = 1; quarter < 4; ++quarter) {
    const std::vector<double> fewer = solve(plan, patch, 0.25 * static_cast<double>(quarter), 5);
    for (std::size_t k = 0; k < full.size(); ++k)
      plan.kinds[k].share[quarter] = full[k] > 0 ? std::min(1.0, fewer[k] / full[k]) : 0;
  }
  return plan;
}

}  // namespace wold
