#include "erosion/stream_power.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/hash.hpp"
#include "erosion/ground.hpp"
#include "erosion/stream_power_levels.hpp"
#include "erosion/stream_power_solver.hpp"
#include "noise/fractal.hpp"
#include "terrain/field_map.hpp"

namespace wold {

namespace {

/// What the input's maps say, over its samples.
struct Factors {
  Grid<float> uplift;
  Grid<float> hardness;
  Grid<float> rain;  ///< empty: 1 everywhere
};

Factors factors_of(const Heightfield& input, const StreamPower& p, const TerrainContext& context) {
  return {factor_map(input, p.uplift_map, 1, context), factor_map(input, p.hardness, 0, context),
          p.rain.empty() ? Grid<float>() : factor_map(input, p.rain, 1, context)};
}

Sides sides_of(OpenSides open) {
  const auto is_one_of = [&](std::initializer_list<OpenSides> those) {
    return open == OpenSides::all || std::find(those.begin(), those.end(), open) != those.end();
  };
  return {.west = is_one_of({OpenSides::west, OpenSides::west_east}),
          .east = is_one_of({OpenSides::east, OpenSides::west_east}),
          .south = is_one_of({OpenSides::south, OpenSides::south_north}),
          .north = is_one_of({OpenSides::north, OpenSides::south_north})};
}

/// How hard the rock is, around 0 and mostly within ±1.
Grid<float> rock_variation(const Heightfield& shape, const StreamPower& p, std::uint64_t seed,
                           Progress& progress) {
  Grid<float> rock(shape.height.width(), shape.height.height(), 0);
  if (p.variation == 0) return rock;
  const double feature = static_cast<double>(p.variation_size);
  fill_fractal(rock, {.hurst = 0.5F}, shape.origin / feature, shape.cell / feature,
               static_cast<std::uint32_t>(random_bits(seed, 1)), progress);
  return rock;
}

StreamPowerGround ground_of(const Heightfield& shape, const Factors& factors, const StreamPower& p,
                            std::uint64_t seed, Progress& progress) {
  const Grid<float> rock = rock_variation(shape, p, seed, progress);
  const auto map = [&](const auto& function) { return map_grid<float>(shape, progress, function); };
  StreamPowerGround ground;
  ground.uplift = map([&](int i, int j) { return 1e-3F * p.uplift * factors.uplift(i, j); });
  ground.erodibility = map([&](int i, int j) {
    return p.erodibility * (1 - factors.hardness(i, j)) * std::exp2(-2 * p.variation * rock(i, j));
  });
  const float steepest = std::tan(radians(p.talus));
  ground.talus =
      map([&](int i, int j) { return steepest * std::max(0.2F, 1 + p.variation * rock(i, j)); });
  if (!factors.rain.empty())
    ground.rain = map_grid<std::int32_t>(shape, progress, [&](int i, int j) {
      return static_cast<std::int32_t>(std::lround(256 * factors.rain(i, j)));
    });
  return ground;
}

Grid<float> difference(const Grid<float>& a, const Grid<float>& b) {
  Grid<float> out = a;
  std::transform(a.values().begin(), a.values().end(), b.values().begin(), out.values().begin(),
                 std::minus<>());
  return out;
}

void add_to(Grid<float>& a, const Grid<float>& b) {
  std::transform(a.values().begin(), a.values().end(), b.values().begin(), a.values().begin(),
                 std::plus<>());
}

/// The maps over the input's samples and those of the coarser grids.
std::vector<Factors> factors_of_levels(const std::vector<StreamPowerLevel>& levels,
                                       const Factors& finest, Progress& progress) {
  std::vector<Factors> out(levels.size());
  out.back() = finest;
  for (std::size_t l = levels.size() - 1; l-- > 0;) {
    const auto coarser = [&](const Grid<float>& map) {
      if (map.empty()) return map;
      Grid<float> grid = regridded(map, levels[l + 1].ground, levels[l].ground, progress);
      for (float& v : grid.values()) v = std::clamp(v, 0.0F, 1.0F);
      return grid;
    };
    const Factors& finer = out[l + 1];
    out[l] = {coarser(finer.uplift), coarser(finer.hardness), coarser(finer.rain)};
  }
  return out;
}

double work_of(const std::vector<StreamPowerLevel>& levels) {
  double cell_steps = 0;
  for (const StreamPowerLevel& level : levels)
    cell_steps += static_cast<double>(level.ground.height.size()) * level.steps;
  return cell_steps;
}

struct Outcome {
  Grid<float> height;
  Grid<float> area;
  Grid<float> sediment;  ///< empty without deposition
};

Outcome run_levels(const std::vector<StreamPowerLevel>& levels, const std::vector<Factors>& factors,
                   const StreamPower& p, const TerrainContext& context) {
  const StreamPowerLaw law{.area_exponent = static_cast<double>(p.area_exponent),
                           .slope_exponent = static_cast<double>(p.slope_exponent),
                           .deposition = static_cast<double>(p.deposition),
                           .diffusivity = static_cast<double>(p.diffusivity),
                           .open = sides_of(p.open)};
  Progress& progress = context.progress;
  Outcome out;
  Grid<float> change;
  for (std::size_t l = 0; l < levels.size(); ++l) {
    const StreamPowerLevel& level = levels[l];
    const Grid<float> ground = level.mesh.shifted(level.ground, progress);
    out.height = ground;
    const auto laid_over = [&](const Grid<float>& values) {
      return levels[l - 1].mesh.laid_over(values, level.mesh, progress);
    };
    if (l > 0) add_to(out.height, laid_over(change));
    StreamPowerSolver solver(level.ground.cell, law,
                             ground_of(level.ground, factors[l], p, context.seed, progress),
                             level.mesh, random_bits(context.seed, 3, l), progress);
    if (!out.sediment.empty()) solver.sediment() = laid_over(out.sediment);
    for (int s = 0; s < level.steps; ++s) solver.step(out.height, level.years / level.steps);
    change = difference(out.height, ground);
    out.area = solver.area();
    out.sediment = solver.sediment();
  }
  return out;
}

void add_maps(TerrainResult& result, const Heightfield& input, const Grid<float>& uplift_factor,
              const StreamPower& p, Progress& progress) {
  const Grid<float>& height = result.field.height;
  const auto map = [&](const auto& function) { return map_grid<float>(input, progress, function); };
  const Grid<float>& area = result.maps["area"];
  result.maps["flow"] = map([&](int i, int j) { return area(i, j) / (area(i, j) + p.river_area); });
  const Grid<float>& uplift = result.maps["uplift"] =
      map([&](int i, int j) { return 1e-3F * p.uplift * p.years * uplift_factor(i, j); });
  Grid<float>& sediment = result.maps["sediment"];
  if (sediment.empty()) sediment = Grid<float>(height.width(), height.height(), 0);
  for (float& s : sediment.values()) s = std::max(0.0F, s);
  const Grid<double> gone = map_grid<double>(input, progress, [&](int i, int j) {
    return static_cast<double>(input.height(i, j)) + static_cast<double>(uplift(i, j)) -
           static_cast<double>(height(i, j));
  });
  result.maps["wear"] = map([&](int i, int j) {
    return std::max(0.0F, static_cast<float>(gone(i, j)) + sediment(i, j));
  });
  const double cell_area = input.cell * input.cell;
  const double added = volume(uplift, input.cell);
  const double removed =
      cell_area * std::accumulate(gone.values().begin(), gone.values().end(), 0.0);
  result.balances = {{.quantity = "ground",
                      .before = volume(input.height, input.cell),
                      .added = added,
                      .removed = removed,
                      .after = volume(height, input.cell),
                      .moved = added + volume(result.maps["wear"], input.cell)}};
}

}  // namespace

Description<StreamPower> describe(const StreamPower&) {
  return Description<StreamPower>(
             "stream_power",
             "Mountains by uplift and running water: valleys that branch and join, ridges with "
             "spurs, over thousands of years in seconds.")
      .add("years", &StreamPower::years, {.unit = "years", .min = 0, .max = 1e9},
           "How long it rains and rises.")
      .add("uplift", &StreamPower::uplift, {.unit = "mm/yr", .min = 0, .max = 1000},
           "How fast the ground rises.")
      .add("uplift_map", &StreamPower::uplift_map,
           "Map from 0 to 1 by which uplift is multiplied; empty: 1 everywhere.")
      .add("erodibility", &StreamPower::erodibility, {.unit = "m^(1-2m)/yr", .min = 0, .max = 10},
           "How fast streams cut into rock; relief in the long run is as uplift over it.")
      .add("hardness", &StreamPower::hardness,
           "Map from 0 to 1: rock of hardness 1 does not erode; empty: 0 everywhere.")
      .add("rain", &StreamPower::rain,
           "Map from 0 to 1 of how much rain falls; empty: 1 everywhere.")
      .add("area_exponent", &StreamPower::area_exponent, {.min = 0, .max = 2},
           "m: how erosion grows with upstream area; m/n is the concavity of rivers.")
      .add("slope_exponent", &StreamPower::slope_exponent, {.min = 0.2, .max = 4},
           "n: how erosion grows with slope.")
      .add("deposition", &StreamPower::deposition, {.min = 0, .max = 10},
           "G: how readily streams lay down what they carry: valley floors and fans; 0: never.")
      .add("diffusivity", &StreamPower::diffusivity, {.unit = "m²/yr", .min = 0, .max = 1000},
           "How fast hillslopes are rounded by creeping soil.")
      .add("talus", &StreamPower::talus, {.unit = "degrees", .min = 1, .max = 85},
           "No slope is steeper; what would be falls and is carried away.")
      .add("variation", &StreamPower::variation, {.min = 0, .max = 1},
           "How much the rock varies from place to place.")
      .add("variation_size", &StreamPower::variation_size, {.unit = "m", .min = 1, .max = 1e6},
           "Size of the largest features of that variation.")
      .choice("open", &StreamPower::open,
              {"all", "west", "east", "south", "north", "west_east", "south_north"},
              "Sides over which water leaves.")
      .add("river_area", &StreamPower::river_area, {.unit = "m²", .min = 1, .max = 1e12},
           "Upstream area at which the map 'flow' is 0.5.");
}

TerrainResult stream_power(const Heightfield& input, const StreamPower& p,
                           const TerrainContext& context) {
  check_erosion(input, p);
  const Factors finest = factors_of(input, p, context);
  const std::vector<StreamPowerLevel> levels =
      stream_power_levels(input, context.domain, static_cast<double>(p.years),
                          random_bits(context.seed, 2), context.progress);
  const ProgressStage stage(context.progress, "stream power", work_of(levels), "cell steps");
  const std::vector<Factors> factors = factors_of_levels(levels, finest, context.progress);
  Outcome out = run_levels(levels, factors, p, context);
  TerrainResult result;
  result.field = {std::move(out.height), input.origin, input.cell};
  result.maps["area"] = std::move(out.area);
  result.maps["sediment"] = std::move(out.sediment);
  add_maps(result, input, finest.uplift, p, context.progress);
  return result;
}

}  // namespace wold
