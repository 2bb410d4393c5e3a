#include "erosion/drainage.hpp"

#include <algorithm>
#include <cmath>

#include "erosion/drainage_area.hpp"
#include "erosion/drainage_depressions.hpp"
#include "erosion/drainage_network.hpp"
#include "erosion/ground.hpp"
#include "terrain/analysis.hpp"
#include "terrain/field_map.hpp"

namespace wold {

namespace {

Grid<double> area_of(const Heightfield& ground, const Drainage& p,
                     const Grid<std::uint8_t>& direction, const FlowOrder& order,
                     Progress& progress) {
  switch (p.flow) {
    case FlowMethod::d_infinity: return d_infinity_area(ground.height, ground.cell, progress);
    case FlowMethod::multiple:
      return multiple_flow_area(ground.height, ground.cell, static_cast<double>(p.exponent),
                                progress);
    case FlowMethod::d8: break;
  }
  return d8_area(direction, order, ground.cell);
}

/// The change from one ground to another: what was added and removed.
Balance balance_of(const Heightfield& before, const Grid<float>& after) {
  struct Sums {
    double added = 0;
    double removed = 0;
  };
  const Sums sums = parallel_reduce(
      0, after.height(), Sums{},
      [&](int j) {
        Sums s;
        for (int i = 0; i < after.width(); ++i) {
          const double change =
              static_cast<double>(after(i, j)) - static_cast<double>(before.height(i, j));
          (change > 0 ? s.added : s.removed) += std::abs(change);
        }
        return s;
      },
      [](const Sums& a, const Sums& b) {
        return Sums{a.added + b.added, a.removed + b.removed};
      });
  const double cell_area = before.cell * before.cell;
  return {.quantity = "ground",
          .before = volume(before.height, before.cell),
          .added = sums.added * cell_area,
          .removed = sums.removed * cell_area,
          .after = volume(after, before.cell),
          .moved = (sums.added + sums.removed) * cell_area};
}

/// The ground with its notches, if there are to be any.
Grid<float> with_notches(const Heightfield& input, const Drainage& p, Progress& progress) {
  if (p.depressions != DepressionMethod::breach) return input.height;
  const BreachLimits limits{static_cast<double>(p.breach_depth),
                            static_cast<double>(p.breach_length)};
  return breach_depressions(input.height, input.cell, limits, progress);
}

Grid<float> lake_depth(const Grid<float>& ground, Progress& progress) {
  Grid<float> depth = fill_depressions(ground, FillSurface::level, progress);
  std::transform(depth.values().begin(), depth.values().end(), ground.values().begin(),
                 depth.values().begin(), [](float level, float h) { return level - h; });
  return depth;
}

Grid<float> wetness_of(const Heightfield& ground, const Grid<float>& area, Progress& progress) {
  return map_grid<float>(ground, progress, [&](int i, int j) {
    const float steepness = glm::length(gradient_at_sample(ground, i, j));
    return std::log(area(i, j) / static_cast<float>(ground.cell) / std::max(steepness, 0.001F));
  });
}

}  // namespace

Description<Drainage> describe(const Drainage&) {
  return Description<Drainage>("drainage",
                               "Leads water from everywhere to the border and maps where it runs: "
                               "upstream area, basins, lakes, rivers.")
      .choice("depressions", &Drainage::depressions, {"fill", "breach", "none"},
              "What is done about pits: filled to where they spill, breached by a notch (deeper "
              "ones filled), or left.")
      .choice("flow", &Drainage::flow, {"d8", "d_infinity", "multiple"},
              "How water divides: all to the steepest neighbour, between the two beside the "
              "steepest direction, or among all lower ones.")
      .add("exponent", &Drainage::exponent, {.min = 0.1, .max = 20},
           "Multiple flow: shares are as slope to this power; the larger, the narrower.")
      .add("river_area", &Drainage::river_area, {.unit = "m²", .min = 1, .max = 1e12},
           "Upstream area from which there is a river.")
      .add("breach_depth", &Drainage::breach_depth, {.unit = "m", .min = 0, .max = 1e4},
           "Notches are no deeper.")
      .add("breach_length", &Drainage::breach_length, {.unit = "m", .min = 0, .max = 1e5},
           "Notches are no longer.")
      .add("change_ground", &Drainage::change_ground,
           "Whether the filled and breached ground comes out, or the ground as it was.");
}

TerrainResult drainage(const Heightfield& input, const Drainage& p, const TerrainContext& context) {
  check_erosion(input, p);
  Progress& progress = context.progress;
  const ProgressStage stage(progress, "drainage", 4, "passes");
  const Grid<float> notched = with_notches(input, p, progress);
  const Heightfield ground{p.depressions == DepressionMethod::none
                               ? notched
                               : fill_depressions(notched, FillSurface::sloping, progress),
                           input.origin, input.cell};
  progress.advance();
  const Grid<std::uint8_t> direction = d8_directions(ground.height, progress);
  const FlowOrder order(direction, progress);
  const Grid<double> exact_area = area_of(ground, p, direction, order, progress);
  progress.advance();

  TerrainResult result;
  const auto map_of = [&](const auto& function) {
    return map_grid<float>(input, progress, function);
  };
  const Grid<float>& area = result.maps["area"] =
      map_of([&](int i, int j) { return static_cast<float>(exact_area(i, j)); });
  result.maps["flow"] =
      map_of([&](int i, int j) { return area(i, j) / (area(i, j) + p.river_area); });
  result.maps["wetness"] = wetness_of(ground, area, progress);
  const Grid<std::int32_t> basins = basin_labels(direction, order);
  progress.advance(0);
  result.maps["basins"] = map_of([&](int i, int j) { return static_cast<float>(basins(i, j)); });
  const Grid<double> d8 = d8_area(direction, order, input.cell);
  progress.advance(0);
  const Grid<std::uint8_t> rivers =
      strahler_order(direction, order, d8, static_cast<double>(p.river_area));
  result.maps["order"] = map_of([&](int i, int j) { return static_cast<float>(rivers(i, j)); });
  progress.advance();
  result.maps["lakes"] = lake_depth(notched, progress);
  progress.advance();
  result.field = p.change_ground ? ground : input;
  result.balances = {balance_of(input, result.field.height)};
  return result;
}

}  // namespace wold
