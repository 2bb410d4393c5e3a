#include "erosion/layers.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "erosion/ground.hpp"
#include "erosion/layers_strata.hpp"
#include "erosion/pipes_ladder.hpp"
#include "erosion/pipes_storm.hpp"
#include "terrain/analysis.hpp"
#include "terrain/field_map.hpp"
#include "terrain/fractal_ground.hpp"
#include "terrain/resample.hpp"

namespace wold {

using namespace layers_detail;
using namespace pipes_detail;

namespace {

constexpr float loose_cover = 0.5F;  // m of loose ground that hide the rock

/// The rock of one grid of the ladder, and the loose ground on it.
struct Rock {
  Heightfield ground;  ///< at first
  Grid<float> offset;  ///< σ + z, m
  Grid<float> ease;    ///< of hardness maps
  Grid<float> loose;   ///< m
  Grid<Grains> seen;   ///< change of the ground when loose ground was counted last
};

class LayeredLand {
 public:
  LayeredLand(const Heightfield& input, const Layers& parameters, const TerrainContext& context)
      : parameters_(parameters), context_(context), stack_(parameters) {
    const HeightStatistics heights = height_statistics(input);
    top_ = parameters.top != 0 ? parameters.top : heights.max;
    mean_ = static_cast<float>(heights.mean);
  }

  MaterialFunction on(const Heightfield& ground, const Grid<Grains>& change,
                      const Grid<float>& ease);
  void add_maps(TerrainResult& result);

 private:
  Grid<float> offset_of(const Heightfield& ground) const;
  void describe_row(Rock& rock, int j, const MaterialRow& row) const;
  void count_loose(Rock& rock, int j, const Grains* change) const;

  const Layers& parameters_;
  const TerrainContext& context_;
  Stack stack_;
  float top_ = 0;
  float mean_ = 0;
  std::shared_ptr<Rock> rock_;
};

Grid<float> LayeredLand::offset_of(const Heightfield& ground) const {
  const Grid<float> waves =
      irregular(ground, parameters_.undulation_size, 3, context_.seed + 1, context_.progress);
  const double angle = radians(static_cast<double>(parameters_.dip_direction));
  const DVec2 down = std::tan(radians(static_cast<double>(parameters_.dip))) *
                     DVec2(std::sin(angle), std::cos(angle));
  return map_grid<float>(ground, context_.progress, [&](int i, int j) {
    const DVec2 place = place_of(ground, i, j) - context_.domain.center();
    return top_ - static_cast<float>(glm::dot(down, place)) + parameters_.undulation * waves(i, j) +
           parameters_.drape * (ground.height(i, j) - mean_);
  });
}

MaterialFunction LayeredLand::on(const Heightfield& ground, const Grid<Grains>& change,
                                 const Grid<float>& ease) {
  auto rock = std::make_shared<Rock>();
  rock->ground = ground;
  rock->offset = offset_of(ground);
  rock->ease = ease;
  rock->seen = change;
  if (rock_ == nullptr) {
    rock->loose = Grid<float>(ground.height.width(), ground.height.height());
  } else {
    rock->loose = resample(rock_->loose, {rock_->ground.origin, rock_->ground.size()},
                           Outside::clamp, ground, context_.progress);
    for (float& r : rock->loose.values()) r = std::max(r, 0.0F);
  }
  rock_ = rock;
  return [this, rock](int j, const MaterialRow& row) { describe_row(*rock, j, row); };
}

void LayeredLand::count_loose(Rock& rock, int j, const Grains* change) const {
  const std::span<float> loose = rock.loose.row(j);
  const std::span<Grains> seen = rock.seen.row(j);
  for (std::size_t i = 0; i < loose.size(); ++i) {
    const float gained = metres_per_grain * static_cast<float>(change[i] - seen[i]);
    loose[i] = std::max(loose[i] + gained, 0.0F);
    seen[i] = change[i];
  }
}

void LayeredLand::describe_row(Rock& rock, int j, const MaterialRow& row) const {
  count_loose(rock, j, row.change);
  const float loose_tangent = std::tan(radians(parameters_.loose_angle));
  for (int i = 0; i < rock.loose.width(); ++i) {
    const float height = row.ground[i] + metres_per_grain * static_cast<float>(row.change[i]);
    const float loose = rock.loose(i, j);
    const float depth = rock.offset(i, j) - (height - loose);
    const Layer& layer = stack_.at(depth);
    const float cover = std::min(loose / loose_cover, 1.0F);
    const float rock_ease = (1 - layer.hardness) * layer.capacity;
    row.ease[i] = rock.ease(i, j) * (rock_ease + cover * (1 - rock_ease));
    row.rise[i] = loose / loose_tangent - stack_.run_of(depth);
    row.tangent[i] = cover < 1 ? layer.tangent : loose_tangent;
  }
}

void LayeredLand::add_maps(TerrainResult& result) {
  const Heightfield& field = result.field;
  const Grid<float> offset = offset_of(rock_->ground);
  const Grid<float>& loose = rock_->loose;
  result.maps["strata"] = map_grid<float>(
      field, context_.progress, [&](int i, int j) { return offset(i, j) - field.height(i, j); });
  result.maps["layer"] = map_grid<float>(field, context_.progress, [&](int i, int j) {
    if (loose(i, j) > loose_cover) return -1.0F;
    return static_cast<float>(stack_.index_at(offset(i, j) - field.height(i, j)));
  });
  result.maps["loose"] = loose;
}

}  // namespace

Pipes canyon_water() {
  Pipes water;
  water.duration = 8;
  water.rain = 8;
  water.lakes = false;
  water.capacity = 3;
  water.stirring = 1;
  water.unevenness = 1;
  return water;
}

Description<Layers> describe(const Layers&) {
  return Description<Layers>("layers",
                             "Water runs over land of hard and soft layers: canyons with cliffs, "
                             "benches and scree. Has the parameters of 'pipes' as well.")
      .add("thickness", &Layers::thickness, {.unit = "m", .min = 0.1, .max = 1e4},
           "Of each layer from the top down; the stack repeats below.")
      .add("layer_hardness", &Layers::layer_hardness, {.min = 0, .max = 1},
           "How much each layer resists water; 1 is never worn.")
      .add("layer_angle", &Layers::layer_angle, {.unit = "degrees", .min = 1, .max = 89},
           "Steepest slope that each layer stands in.")
      .add("layer_capacity", &Layers::layer_capacity, {.min = 0, .max = 100},
           "Factor of how fast water takes up each layer.")
      .add("top", &Layers::top, {.unit = "m", .min = -1e4, .max = 1e4},
           "Height of the top of the stack; 0: the highest ground.")
      .add("dip", &Layers::dip, {.unit = "degrees", .min = 0, .max = 60}, "Tilt of the layers.")
      .add("dip_direction", &Layers::dip_direction, {.unit = "degrees", .min = -360, .max = 360},
           "Where they go down, clockwise from north.")
      .add("undulation", &Layers::undulation, {.unit = "m", .min = 0, .max = 1000},
           "How far they are warped up and down.")
      .add("undulation_size", &Layers::undulation_size, {.unit = "m", .min = 1, .max = 1e6},
           "Distance of their swells.")
      .add("drape", &Layers::drape, {.min = 0, .max = 1},
           "How far they follow the land: 0 level, 1 along it.")
      .add("loose_angle", &Layers::loose_angle, {.unit = "degrees", .min = 1, .max = 89},
           "Steepest slope of scree and sediment.")
      .include(&Layers::water);
}

TerrainResult layers(const Heightfield& input, const Layers& parameters,
                     const TerrainContext& context) {
  check_erosion(input, parameters);
  LayeredLand land(input, parameters, context);
  TerrainResult result =
      storm(input, parameters.water, context,
            [&](const Heightfield& ground, const Grid<Grains>& change, const Grid<float>& ease) {
              return land.on(ground, change, ease);
            });
  land.add_maps(result);
  return result;
}

}  // namespace wold
