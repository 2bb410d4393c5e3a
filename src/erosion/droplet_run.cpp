#include "erosion/droplet_run.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "base/parallel.hpp"
#include "erosion/droplet_rates.hpp"
#include "erosion/ground.hpp"
#include "terrain/import.hpp"

namespace wold {

namespace {

constexpr int showers_of_rain = 64;
constexpr int recorded_showers = 16;  // the last: on ground that is nearly done
constexpr int rows_of_task = 16;
constexpr double drops_of_round = 128;  // in a tile at least, before changes are spread

/// How many values an array in rows of `droplet_stride` has.
std::size_t padded_size(const Heightfield& input) {
  return static_cast<std::size_t>(droplet_stride(input.height.width())) *
         static_cast<std::size_t>(input.height.height());
}

/// Calls `use(k, (i, j))` for each sample, with its place in an array in rows of `droplet_stride`.
template <class Use>
void for_samples(int width, int height, Progress& progress, const Use& use) {
  parallel_for(
      0, height,
      [&](int j) {
        const auto first = static_cast<std::size_t>(j) * droplet_stride(width);
        for (int i = 0; i < width; ++i) use(first + static_cast<std::size_t>(i), IVec2(i, j));
        progress.advance(0);
      },
      rows_of_task);
}

/// Share of the erosion that each sample lets happen.
std::vector<float> softness_of(const Heightfield& input, const Droplets& p,
                               const TerrainContext& context) {
  const Grid<float> hardness = factor_map(input, p.hardness, 0, context);
  std::vector<float> softness(padded_size(input));
  for_samples(hardness.width(), hardness.height(), context.progress, [&](std::size_t k, IVec2 at) {
    const float h = hardness(at.x, at.y);
    softness[k] = p.hardness_invert ? h : 1 - h;
  });
  return softness;
}

DropletColors colors_of(const Heightfield& input, const Droplets& p, double quantum,
                        const TerrainContext& context) {
  const std::filesystem::path path = context.folder / p.color.path;
  DropletColors colors;
  colors.beneath.resize(padded_size(input));
  const char* const channels[] = {"R", "G", "B"};
  for (int c = 0; c < 3; ++c) {
    const Grid<float> values =
        picture_over(path, channels[c], context.domain, input, context.progress);
    for_samples(values.width(), values.height(), context.progress,
                [&](std::size_t k, IVec2 at) { colors.beneath[k][c] = values(at.x, at.y); });
  }
  colors.skin = colors.beneath;
  colors.depth = static_cast<float>(static_cast<double>(p.color_depth) / quantum);
  return colors;
}

void add_color_maps(const DropletColors& colors, int width, int height, Progress& progress,
                    TerrainResult& result) {
  const char* const names[] = {"color.red", "color.green", "color.blue"};
  for (int c = 0; c < 3; ++c) {
    Grid<float> map(width, height);
    for_samples(width, height, progress,
                [&](std::size_t k, IVec2 at) { map(at.x, at.y) = colors.skin[k][c]; });
    result.maps.emplace(names[c], std::move(map));
    progress.advance();
  }
}

/// What was taken up and what was laid down: their difference is the change of the height.
std::pair<Grid<float>, Grid<float>> wear_and_sediment(const Grid<float>& before,
                                                      const Grid<float>& after,
                                                      const Grid<float>& worn, Progress& progress) {
  std::pair<Grid<float>, Grid<float>> maps{{worn.width(), worn.height()},
                                           {worn.width(), worn.height()}};
  parallel_for(
      0, worn.height(),
      [&](int j) {
        for (int i = 0; i < worn.width(); ++i) {
          const float change = after(i, j) - before(i, j);
          const float laid = std::max(0.0F, change + worn(i, j));
          maps.first(i, j) = laid - change;
          maps.second(i, j) = laid;
        }
        progress.advance(0);
      },
      rows_of_task);
  return maps;
}

}  // namespace

DropletRun::DropletRun(const Heightfield& input, const Droplets& parameters,
                       const TerrainContext& context)
    : input_(input),
      parameters_(parameters),
      context_(context),
      ground_(input),
      rates_(droplet_rates(parameters, input.cell, ground_.quantum())),
      radius_cells_(static_cast<double>(parameters.radius) / input.cell) {
  world_.width = input.height.width();
  world_.height = input.height.height();
  world_.stride = droplet_stride(world_.width);
  world_.cells = ground_.cells();
  world_.closed_border = parameters.closed_border;
  if (!parameters.hardness.empty()) {
    softness_ = softness_of(input, parameters, context);
    world_.softness = softness_.data();
  }
  if (!parameters.rain_map.empty())
    rain_share_ = factor_map(input, parameters.rain_map, 1, context);
  if (!parameters.color.empty()) {
    colors_ = colors_of(input, parameters, ground_.quantum(), context);
    world_.colors = &colors_;
  }
}

void DropletRun::rain() {
  if (!(parameters_.rain > 0)) return;
  const double area = input_.size().x * input_.size().y;
  const double rain = static_cast<double>(parameters_.rain);
  context_.progress.begin("droplets", rain * area, "drops");
  const double per_cell = rain / showers_of_rain * input_.cell * input_.cell;
  const int side = droplet_tile_side(per_cell);
  DropletTiles tiles(input_, side, rain_share_.empty() ? nullptr : &rain_share_);
  const auto at_once = static_cast<int>(std::bit_floor(
      static_cast<unsigned>(std::clamp(drops_of_round / (per_cell * side * side), 1.0, 8.0))));
  // Eight neighbours spread a share c each by the variance 6 c cell² along each axis.
  const double creep_cells = static_cast<double>(parameters_.creep) / input_.cell;
  settled_rounds_ = at_once == 1 ? 2 : 1;
  creep_ = creep_cells * creep_cells * at_once * settled_rounds_ / (6 * showers_of_rain);
  const std::vector<DropletShower> showers = droplet_showers(rain, showers_of_rain, context_.seed);
  for (int k = 0; k < showers_of_rain; k += at_once) {
    if (k == showers_of_rain - recorded_showers) start_record();
    for (int n = k; n < k + at_once; ++n)
      tiles.rain(showers[static_cast<std::size_t>(n)], rates_.steps);
    round(tiles, k);
  }
  for (int k = 0; !tiles.empty(); ++k) round(tiles, k);
  removed_ = ground_.quantum() * static_cast<double>(tiles.removed);
  steps_ = tiles.steps;
}

void DropletRun::round(DropletTiles& tiles, int k) {
  tiles.move(world_, rates_, k, context_.progress);
  ground_.spread_changes(radius_cells_, world_.softness, context_.progress);
  if (++rounds_ % settled_rounds_ != 0) return;
  ground_.settle(std::tan(radians(static_cast<double>(parameters_.bank_slope))), creep_,
                 input_.cell, world_.softness, context_.progress);
}

void DropletRun::start_record() {
  record_.rain = static_cast<double>(parameters_.rain) * recorded_showers / showers_of_rain;
  record_.passes.resize(padded_size(input_));
  world_.passes = record_.passes.data();
}

TerrainResult DropletRun::result() {
  const int width = world_.width;
  const int height = world_.height;
  Progress& progress = context_.progress;
  progress.begin("maps of droplets", world_.colors == nullptr ? 6 : 9, "maps");
  TerrainResult result{{ground_.eroded(input_, progress), input_.origin, input_.cell}, {}, {}};
  progress.advance();
  const Grid<float> worn = ground_.wear(radius_cells_, world_.softness, progress);
  auto [wear, sediment] = wear_and_sediment(input_.height, result.field.height, worn, progress);
  progress.advance(2);
  result.maps.emplace("wear", std::move(wear));
  result.maps.emplace("sediment", std::move(sediment));
  record_.passes.resize(padded_size(input_));
  Grid<float> discharge = discharge_map(record_, width, height, progress);
  progress.advance();
  result.maps.emplace("flow", flow_map(discharge, input_.cell, parameters_.contrast, progress));
  progress.advance();
  result.maps.emplace("discharge", std::move(discharge));
  result.maps.emplace("velocity", velocity_map(record_, width, height, progress));
  progress.advance();
  if (world_.colors != nullptr) add_color_maps(colors_, width, height, progress, result);
  result.balances.push_back(balance(result.field));
  progress.end();
  return result;
}

Balance DropletRun::balance(const Heightfield& output) const {
  const double cell_area = input_.cell * input_.cell;
  Balance ground{"ground", volume(input_.height, input_.cell)};
  ground.removed = removed_ * cell_area;
  ground.after = volume(output.height, input_.cell);
  ground.moved = ground_.total_wear() * cell_area;
  return ground;
}

}  // namespace wold
