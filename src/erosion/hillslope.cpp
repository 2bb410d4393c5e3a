#include "erosion/hillslope.hpp"

#include <algorithm>
#include <cmath>

#include "erosion/ground.hpp"
#include "erosion/hillslope_solver.hpp"
#include "terrain/field_map.hpp"

namespace wold {

namespace {

Sides held_sides(HillslopeBorder border) {
  const bool open = border == HillslopeBorder::open;
  return {open, open, open, open};
}

/// κ t, m².
double spread_of(const Hillslope& p) {
  return static_cast<double>(p.diffusivity) * static_cast<double>(p.years);
}

void creep_linearly(Grid<double>& height, double cell, const Hillslope& p, Progress& progress) {
  const double spread = spread_of(p) / (cell * cell);
  const int steps = std::clamp(static_cast<int>(std::ceil(spread / 0.5)), 1, 400);
  for (int s = 0; s < steps; ++s) {
    diffuse(height, spread / steps, held_sides(p.border), progress);
    progress.advance(spread_of(p) / steps);
  }
}

/// Creep with a critical slope. Fluxes are those through the east and north sides of cells.
class CriticalCreep {
 public:
  CriticalCreep(Grid<double>& height, double cell, const Hillslope& p)
      : height_(height),
        cell_(cell),
        critical_(std::tan(radians(static_cast<double>(p.critical_slope)))),
        open_(p.border == HillslopeBorder::open),
        east_(height.width(), height.height(), 0),
        north_(height.width(), height.height(), 0) {}

  /// Fills the fluxes for κ = 1 (m² per unit of time) and returns the largest κ_S / κ.
  double find_fluxes(Progress& progress) {
    return parallel_reduce(
        0, height_.height(), 1.0,
        [&](int j) {
          progress.advance(0);
          double most = 1;
          for (int i = 0; i < height_.width(); ++i) {
            east_(i, j) = flux(i, j, 1, 0, most);
            north_(i, j) = flux(i, j, 0, 1, most);
          }
          return most;
        },
        [](double a, double b) { return std::max(a, b); });
  }

  /// Moves what flows in a time times κ of `spread` (m²).
  void move(double spread, Progress& progress) {
    const double per_cell = spread / cell_;
    parallel_for(0, height_.height(), [&](int j) {
      progress.advance(0);
      for (int i = 0; i < height_.width(); ++i) {
        if (open_ && is_border(i, j)) continue;
        const double from_west = i > 0 ? east_(i - 1, j) : 0;
        const double from_south = j > 0 ? north_(i, j - 1) : 0;
        height_(i, j) += per_cell * (from_west - east_(i, j) + from_south - north_(i, j));
      }
    });
  }

 private:
  bool is_border(int i, int j) const {
    return i == 0 || j == 0 || i == height_.width() - 1 || j == height_.height() - 1;
  }

  /// Through the side towards (i + x, j + y).
  double flux(int i, int j, int x, int y, double& most) const {
    if (i + x >= height_.width() || j + y >= height_.height()) return 0;
    const double slope = (height_(i, j) - height_(i + x, j + y)) / cell_;
    const auto across = [&](int a, int b) {
      return height_.clamped(a + y, b + x) - height_.clamped(a - y, b - x);
    };
    const double slope_across = (across(i, j) + across(i + x, j + y)) / (4 * cell_);
    const double steepness =
        (slope * slope + slope_across * slope_across) / (critical_ * critical_);
    const double factor = 1 / (1 - std::min(0.95, steepness));
    most = std::max(most, factor);
    return slope * factor;
  }

  Grid<double>& height_;
  double cell_;
  double critical_;
  bool open_;
  Grid<double> east_;
  Grid<double> north_;
};

void creep_critically(Grid<double>& height, double cell, const Hillslope& p, Progress& progress) {
  CriticalCreep creep(height, cell, p);
  double left = spread_of(p);
  while (left > 0) {
    const double spread = std::min(left, 0.2 * cell * cell / creep.find_fluxes(progress));
    creep.move(spread, progress);
    left -= spread;
    progress.advance(spread);
  }
}

Balance balance_of(const Heightfield& before, const Grid<float>& after, const Grid<float>& change,
                   bool open) {
  Balance balance{.quantity = "ground",
                  .before = volume(before.height, before.cell),
                  .after = volume(after, before.cell)};
  double moved = 0;
  double net = 0;
  for (const float c : change.values()) {
    moved += std::abs(static_cast<double>(c));
    net += static_cast<double>(c);
  }
  const double cell_area = before.cell * before.cell;
  balance.moved = moved * cell_area;
  if (open) (net > 0 ? balance.added : balance.removed) = std::abs(net) * cell_area;
  return balance;
}

}  // namespace

Description<Hillslope> describe(const Hillslope&) {
  return Description<Hillslope>("hillslope", "Rounds the ground as creeping soil does.")
      .add("years", &Hillslope::years, {.unit = "years", .min = 0, .max = 1e9}, "How long.")
      .add("diffusivity", &Hillslope::diffusivity, {.unit = "m²/yr", .min = 0, .max = 1000},
           "How fast soil creeps: its flow per width is this times the slope.")
      .add("critical_slope", &Hillslope::critical_slope, {.unit = "degrees", .min = 0, .max = 85},
           "Soil runs off as slopes near this; 0: the flow is in proportion to slope.")
      .choice("border", &Hillslope::border, {"closed", "open"},
              "Closed: nothing passes. Open: heights along it stay and ground passes.");
}

TerrainResult hillslope(const Heightfield& input, const Hillslope& p,
                        const TerrainContext& context) {
  check_erosion(input, p);
  Progress& progress = context.progress;
  const ProgressStage stage(progress, "hillslope", spread_of(p), "m²");
  const auto input_height = [&](int i, int j) { return static_cast<double>(input.height(i, j)); };
  Grid<double> height = map_grid<double>(input, progress, input_height);
  if (p.critical_slope > 0)
    creep_critically(height, input.cell, p, progress);
  else
    creep_linearly(height, input.cell, p, progress);
  TerrainResult result;
  result.field = {map_grid<float>(input, progress,
                                  [&](int i, int j) { return static_cast<float>(height(i, j)); }),
                  input.origin, input.cell};
  result.maps["change"] = map_grid<float>(input, progress, [&](int i, int j) {
    return static_cast<float>(height(i, j) - input_height(i, j));
  });
  result.balances = {balance_of(input, result.field.height, result.maps["change"],
                                p.border == HillslopeBorder::open)};
  return result;
}

double reach_of(const Hillslope& p, double cell) {
  return cell + 6 * std::sqrt(2 * spread_of(p));
}

}  // namespace wold
