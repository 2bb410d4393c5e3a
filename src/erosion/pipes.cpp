#include "erosion/pipes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "erosion/ground.hpp"
#include "erosion/pipes_ladder.hpp"
#include "terrain/field_map.hpp"
#include "terrain/resample.hpp"
#include "terrain/step_mask.hpp"

namespace wold {

using namespace pipes_detail;

namespace {

constexpr float deepest_at_first = 300;  // m

TerrainDomain extent_of(const Heightfield& field) {
  return {field.origin, field.size()};
}

void check_springs(const Heightfield& input, const Pipes& p) {
  if (p.spring_places.size() != 2 * p.spring_rates.size())
    throw Error(ErrorKind::input,
                fmt::format("'spring_places' needs an x and a y for each of the 'spring_rates'; "
                            "there are {} numbers for {} rates",
                            p.spring_places.size(), p.spring_rates.size()));
  for (std::size_t k = 0; k < p.spring_rates.size(); ++k) {
    const DVec2 place(p.spring_places[2 * k], p.spring_places[2 * k + 1]);
    if (!(p.spring_rates[k] >= 0) || p.spring_rates[k] > 1e6)
      throw Error(ErrorKind::input,
                  fmt::format("'spring_rates' are 0 to 1e+06 m³/s, not {:g}", p.spring_rates[k]));
    if (!input.contains(place))
      throw Error(ErrorKind::input,
                  fmt::format("'spring_places' has ({:g}, {:g}), which is not on the land: x goes "
                              "from {:g} to {:g}, y from {:g} to {:g}",
                              place.x, place.y, input.origin.x, input.origin.x + input.size().x,
                              input.origin.y, input.origin.y + input.size().y));
  }
}

/// Adds a spring's water to the cells around it, more in the middle.
void add_spring(Grid<float>& inflow, const Heightfield& ground, DVec2 place, double rate,
                double radius) {
  const double reach = std::max(radius, 1.5 * ground.cell);
  const DVec2 at = (place - ground.origin) / ground.cell;
  const double cells = reach / ground.cell;
  const auto weight = [&](int i, int j) {
    return std::max(0.0, cells - glm::length(DVec2(i, j) - at));
  };
  const auto each = [&](const auto& function) {
    const int i0 = std::max(0, static_cast<int>(at.x - cells));
    const int j0 = std::max(0, static_cast<int>(at.y - cells));
    const int i1 = std::min(inflow.width() - 1, static_cast<int>(at.x + cells) + 1);
    const int j1 = std::min(inflow.height() - 1, static_cast<int>(at.y + cells) + 1);
    for (int j = j0; j <= j1; ++j)
      for (int i = i0; i <= i1; ++i) function(i, j);
  };
  double sum = 0;
  each([&](int i, int j) { sum += weight(i, j); });
  const double per_weight = rate / (sum * ground.cell * ground.cell);
  each([&](int i, int j) { inflow(i, j) += static_cast<float>(weight(i, j) * per_weight); });
}

Grid<float> inflow_over(const Heightfield& ground, const Grid<float>& rain, const Pipes& p) {
  Grid<float> inflow = rain;
  const float metres_per_second = p.rain / 1000 / 3600;
  for (float& v : inflow.values()) v = std::clamp(v, 0.0F, 1.0F) * metres_per_second;
  for (std::size_t k = 0; k < p.spring_rates.size(); ++k)
    add_spring(inflow, ground, {p.spring_places[2 * k], p.spring_places[2 * k + 1]},
               p.spring_rates[k], static_cast<double>(p.spring_radius));
  return inflow;
}

Grid<float> water_at_first(const Heightfield& input, const Pipes& p,
                           const TerrainContext& context) {
  if (p.water.empty()) return {input.height.width(), input.height.height(), 0};
  Grid<float> water = map_over(input, p.water, context);
  for (float& d : water.values()) {
    if (!std::isfinite(d) || d > deepest_at_first)
      throw Error(ErrorKind::input,
                  fmt::format("the map '{}' of 'water' holds depths beyond 0 to {:g} m", p.water,
                              static_cast<double>(deepest_at_first)));
    d = std::max(d, 0.0F);
  }
  return water;
}

/// The whole work on one piece of land.
class Storm {
 public:
  Storm(const Heightfield& input, const Pipes& parameters, const TerrainContext& context)
      : input_(input), parameters_(parameters), context_(context) {
    ease_ =
        factor_map(input, parameters.hardness, parameters.hardness_invert ? 1.0F : 0.0F, context);
    if (!parameters.hardness_invert)
      for (float& e : ease_.values()) e = 1 - e;
    rain_ = factor_map(input, parameters.rain_map, 1, context);
  }

  void run() {
    const std::vector<Heightfield> rungs =
        ladder_of(input_, static_cast<double>(parameters_.start_cell));
    double work = 0;
    for (std::size_t k = 0; k < rungs.size(); ++k)
      work += static_cast<double>(rungs[k].height.size()) *
              PipeSolver::step_count(seconds_on(static_cast<int>(k), parameters_), rungs[k].cell,
                                     parameters_);
    context_.progress.begin("pipes", work, "cell steps");
    for (std::size_t k = 0; k < rungs.size(); ++k) {
      const bool last = k + 1 == rungs.size();
      begin(last ? input_ : ground_over(rungs[k]));
      solver_->run(seconds_on(static_cast<int>(k), parameters_), context_.progress);
      add_sums();
    }
    context_.progress.end();
  }

  TerrainResult result() const;

 private:
  Grid<float> over(const Grid<float>& grid, const Heightfield& like) const {
    if (grid.same_shape(like.height)) return grid;
    return resample(grid, extent_of(input_), Outside::clamp, like, context_.progress);
  }
  Heightfield ground_over(Heightfield rung) const {
    rung.height = over(input_.height, rung);
    return rung;
  }
  void begin(const Heightfield& ground);
  void add_sums();

  const Heightfield& input_;
  const Pipes& parameters_;
  const TerrainContext& context_;
  Grid<float> ease_;
  Grid<float> rain_;
  std::unique_ptr<PipeSolver> solver_;
  Balance water_{.quantity = "water"};
  Balance earth_{.quantity = "ground"};
};

void Storm::begin(const Heightfield& ground) {
  PipeStart start;
  start.ease = over(ease_, ground);
  start.inflow = inflow_over(ground, over(rain_, ground), parameters_);
  if (solver_ == nullptr) {
    const int width = ground.height.width();
    const int height = ground.height.height();
    start.change = start.sediment = Grid<Grains>(width, height);
    const Grid<float> water = water_at_first(input_, parameters_, context_);
    water_.before = volume(water, input_.cell);
    Grid<float> depth = over(water, ground);
    for (float& d : depth.values()) d = std::max(d, 0.0F);
    start.depth = to_grains(depth, ground.cell, water_.before);
    if (parameters_.lakes && parameters_.border == WaterBorder::open) {
      const Grid<float> hollows = hollow_depth(ground);
      const float deepest = *std::max_element(hollows.values().begin(), hollows.values().end());
      const float without = std::max(deepest - deepest_at_first, 0.0F);
      for (std::size_t k = 0; k < hollows.size(); ++k)
        start.depth.values()[k] = std::max(
            start.depth.values()[k],
            static_cast<Grains>(std::max(hollows.values()[k] - without, 0.0F) * grains_per_metre));
      water_.added = volume_of(start.depth, ground.cell) - water_.before;
    }
  } else {
    Brought brought = bring(*solver_, ground, context_.progress);
    start.change = std::move(brought.change);
    start.depth = std::move(brought.depth);
    start.sediment = std::move(brought.sediment);
  }
  start.ground = ground;
  solver_ = std::make_unique<PipeSolver>(std::move(start), parameters_);
}

void Storm::add_sums() {
  const double cell = solver_->ground().cell;
  const double per_grain = cell * cell * static_cast<double>(metres_per_grain);
  const GrainSums& sums = solver_->sums();
  water_.added += per_grain * static_cast<double>(sums.water_in);
  water_.removed += per_grain * static_cast<double>(sums.water_evaporated + sums.water_out);
  earth_.removed += per_grain * static_cast<double>(sums.sediment_out);
  earth_.moved += per_grain * static_cast<double>(sums.taken_up);
}

TerrainResult Storm::result() const {
  const double cell = input_.cell;
  const Grid<Grains> change = solver_->change();
  const Grid<Grains> sediment = solver_->sediment();
  TerrainResult out;
  out.field = input_;
  Grid<float> laid(change.width(), change.height());
  Grid<float> worn = laid;
  double left = 0;  // what rounding to float leaves goes to the next sample
  for (std::size_t k = 0; k < change.size(); ++k) {
    const Grains grains = change.values()[k] + sediment.values()[k];
    if (grains == 0) continue;
    const double metres = static_cast<double>(metres_per_grain) * grains;
    const double exact = static_cast<double>(input_.height.values()[k]) + metres + left;
    const auto rounded = static_cast<float>(exact);
    left = exact - static_cast<double>(rounded);
    out.field.height.values()[k] = rounded;
    laid.values()[k] = static_cast<float>(std::max(metres, 0.0));
    worn.values()[k] = static_cast<float>(std::max(-metres, 0.0));
  }
  Grid<float> east = solver_->velocity_x();
  Grid<float> north = solver_->velocity_y();
  Grid<float> speed = map_grid<float>(
      input_, context_.progress, [&](int i, int j) { return std::hypot(east(i, j), north(i, j)); });
  Balance water = water_;
  water.after = volume_of(solver_->depth(), cell);
  water.moved = water.before + water.added;
  Balance earth = earth_;
  earth.before = volume(input_.height, cell);
  earth.after = volume(out.field.height, cell);
  out.balances = {earth, water};
  out.maps["water"] = to_metres(solver_->depth());
  out.maps["wetness"] = solver_->wetness();
  out.maps["velocity"] = std::move(speed);
  out.maps["velocity_x"] = std::move(east);
  out.maps["velocity_y"] = std::move(north);
  out.maps["sediment"] = std::move(laid);
  out.maps["wear"] = std::move(worn);
  out.maps["carried"] = to_metres(sediment);
  return out;
}

}  // namespace

Description<Pipes> describe(const Pipes&) {
  return Description<Pipes>("pipes",
                            "Rain and springs run down the land, carve valleys and lay down fans; "
                            "rivers and lakes come out as maps.")
      .add("duration", &Pipes::duration, {.unit = "h", .min = 0, .max = 1e4},
           "How long it rains, on the coarsest grid; each finer one adds a quarter of that.")
      .add("rain", &Pipes::rain, {.unit = "mm/h", .min = 0, .max = 1e4}, "How much.")
      .add("rain_map", &Pipes::rain_map,
           "Map that multiplies the rain (0 to 1): a step, a map, a picture.")
      .add("spring_places", &Pipes::spring_places, {.unit = "m"},
           "Where springs rise: x and y of the first, x and y of the second, …")
      .add("spring_rates", &Pipes::spring_rates, {.unit = "m³/s", .min = 0, .max = 1e6},
           "How much water each spring gives.")
      .add("spring_radius", &Pipes::spring_radius, {.unit = "m", .min = 0, .max = 1e4},
           "Over how wide a place.")
      .add("water", &Pipes::water, "Map of the water's depth (m) at the beginning.")
      .add("lakes", &Pipes::lakes,
           "Whether hollows are full of water at the beginning (with an open border).")
      .add("evaporation", &Pipes::evaporation, {.unit = "1/h", .min = 0, .max = 1000},
           "Share of the water's depth that evaporates in an hour.")
      .choice(
          "border", &Pipes::border, {"open", "closed", "periodic"},
          "What happens to water at the border: it leaves, is held, or comes in again opposite.")
      .add("capacity", &Pipes::capacity, {.unit = "s", .min = 0, .max = 1000},
           "Ground that water carries at 1 m/s down a vertical slope, m; large values press ages "
           "into "
           "hours.")
      .add("full_depth", &Pipes::full_depth, {.unit = "m", .min = 0.0001, .max = 1000},
           "Water less deep than this carries less.")
      .add("least_slope", &Pipes::least_slope, {.unit = "degrees", .min = 0, .max = 45},
           "Flatter ground wears as if it were that steep.")
      .add("dissolving", &Pipes::dissolving, {.unit = "1/s", .min = 0, .max = 100},
           "How fast water takes up what it lacks.")
      .add("depositing", &Pipes::depositing, {.unit = "1/s", .min = 0, .max = 100},
           "How fast water lays down what it carries too much.")
      .add("bank_angle", &Pipes::bank_angle, {.unit = "degrees", .min = 1, .max = 89},
           "Ground that is steeper slides.")
      .add("stirring", &Pipes::stirring, {.min = 0, .max = 100},
           "How far what is carried strays down side slopes: wide, smooth river beds.")
      .add("hardness", &Pipes::hardness,
           "Map of what resists (0 to 1, white does not wear): a step, a map, a picture.")
      .add("hardness_invert", &Pipes::hardness_invert, "Whether black is hard instead.")
      .add("drag", &Pipes::drag, {.min = 0, .max = 10},
           "Friction at the bed: shear stress over density and squared speed.")
      .add("pipe_depth", &Pipes::pipe_depth, {.unit = "m", .min = 0.01, .max = 1000},
           "Deeper water levels out as slowly as if it were that deep; longer steps for it.")
      .add("top_speed", &Pipes::top_speed, {.unit = "m/s", .min = 0.01, .max = 100},
           "Water is never faster.")
      .add("start_cell", &Pipes::start_cell, {.unit = "m", .min = 0, .max = 1e5},
           "Cell of the coarsest grid; 0: 128 cells across the land.");
}

TerrainResult pipes(const Heightfield& input, const Pipes& parameters,
                    const TerrainContext& context) {
  check_erosion(input, parameters);
  check_springs(input, parameters);
  Storm storm(input, parameters, context);
  storm.run();
  return storm.result();
}

}  // namespace wold
