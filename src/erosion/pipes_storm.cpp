#include "erosion/pipes_storm.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "base/parallel.hpp"
#include "erosion/ground.hpp"
#include "erosion/pipes_input.hpp"
#include "erosion/pipes_ladder.hpp"
#include "terrain/field_map.hpp"
#include "terrain/fractal_ground.hpp"
#include "terrain/resample.hpp"

namespace wold::pipes_detail {

namespace {

constexpr float rock_feature = 150;  // m, distance of hard spots
constexpr int rock_octaves = 5;

TerrainDomain extent_of(const Heightfield& field) {
  return {field.origin, field.size()};
}

/// The whole work on one piece of land.
class Storm {
 public:
  Storm(const Heightfield& input, const Pipes& parameters, const TerrainContext& context,
        const RockFunction& rock)
      : input_(input), parameters_(parameters), context_(context), rock_(rock) {
    ease_ = ease_of(input, parameters.hardness, parameters.hardness_invert, context);
    rain_ = factor_map(input, parameters.rain_map, 1, context);
  }

  void run() {
    const std::vector<Heightfield> rungs =
        ladder_of(input_, static_cast<double>(parameters_.start_cell));
    for (std::size_t k = 0; k < rungs.size(); ++k) {
      const bool last = k + 1 == rungs.size();
      const double seconds = seconds_on(static_cast<int>(k), parameters_);
      begin(last ? input_ : ground_over(rungs[k]));
      const double cell = solver_->ground().cell;
      const ProgressStage stage(context_.progress,
                                fmt::format("water over cells of {:.3g} m", cell), seconds, "s");
      solver_->run(seconds, context_.progress);
      add_sums();
    }
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
  Grid<float> uneven_ease(const Heightfield& ground) const;
  void begin(const Heightfield& ground);
  void add_sums();

  const Heightfield& input_;
  const Pipes& parameters_;
  const TerrainContext& context_;
  const RockFunction& rock_;
  Grid<float> ease_;
  Grid<float> rain_;
  std::unique_ptr<PipeSolver> solver_;
  Balance water_{.quantity = "water"};
  Balance earth_{.quantity = "ground"};
};

Grid<float> Storm::uneven_ease(const Heightfield& ground) const {
  Grid<float> ease = over(ease_, ground);
  if (parameters_.unevenness <= 0) return ease;
  const Grid<float> noise =
      irregular(ground, rock_feature, rock_octaves, context_.seed, context_.progress);
  parallel_for(
      0, ease.height(),
      [&](int j) {
        context_.progress.advance(0);
        for (int i = 0; i < ease.width(); ++i)
          ease(i, j) *= std::exp(2 * parameters_.unevenness * noise(i, j));
      },
      16);
  return ease;
}

void Storm::begin(const Heightfield& ground) {
  PipeStart start;
  start.ease = uneven_ease(ground);
  start.inflow = inflow_over(ground, over(rain_, ground), parameters_);
  if (solver_ == nullptr) {
    const int width = ground.height.width();
    const int height = ground.height.height();
    start.change = start.sediment = Grid<Grains>(width, height);
    const Grid<float> water = depth_map(input_, parameters_.water, context_);
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
  if (rock_) start.material = rock_(ground, start.change, start.ease);
  solver_ = std::make_unique<PipeSolver>(std::move(start), parameters_, context_.progress);
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
  const auto made = [&](auto grid) {
    context_.progress.advance(0);
    return grid;
  };
  const Grid<Grains> change = made(solver_->change());
  const Grid<Grains> sediment = made(solver_->sediment());
  const Grid<Grains> depth = made(solver_->depth());
  TerrainResult out;
  out.field = made(changed_ground(input_, change, sediment, out.maps, context_.progress));
  Grid<float> east = made(solver_->velocity_x());
  Grid<float> north = made(solver_->velocity_y());
  Grid<float> speed = map_grid<float>(
      input_, context_.progress, [&](int i, int j) { return std::hypot(east(i, j), north(i, j)); });
  Balance water = water_;
  water.after = volume_of(depth, cell);
  water.moved = water.before + water.added;
  Balance earth = earth_;
  earth.before = volume(input_.height, cell);
  earth.after = volume(out.field.height, cell);
  out.balances = {earth, water};
  out.maps["water"] = made(to_metres(depth));
  out.maps["wetness"] = made(solver_->wetness());
  out.maps["velocity"] = std::move(speed);
  out.maps["velocity_x"] = std::move(east);
  out.maps["velocity_y"] = std::move(north);
  return out;
}

}  // namespace

TerrainResult storm(const Heightfield& input, const Pipes& parameters,
                    const TerrainContext& context, const RockFunction& rock) {
  check_springs(input, parameters);
  const ProgressStage stage(context.progress, "water", 0, "");
  Storm storm(input, parameters, context, rock);
  storm.run();
  return storm.result();
}

}  // namespace wold::pipes_detail
