#include "erosion/droplets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "erosion/droplet_ground.hpp"
#include "erosion/droplet_maps.hpp"
#include "erosion/droplet_rain.hpp"
#include "erosion/droplet_rates.hpp"
#include "erosion/ground.hpp"
#include "terrain/import.hpp"

namespace wold {

namespace {

constexpr int showers_of_rain = 64;
constexpr int recorded_showers = 16;    // the last: on ground that is nearly done
constexpr double drops_of_round = 128;  // in a tile at least, before changes are spread

/// Share of the erosion that each sample lets happen.
Grid<float> softness_of(const Heightfield& input, const Droplets& p,
                        const TerrainContext& context) {
  Grid<float> softness = factor_map(input, p.hardness, 0, context);
  if (!p.hardness_invert)
    for (float& s : softness.values()) s = 1 - s;
  return softness;
}

DropletColors colors_of(const Heightfield& input, const Droplets& p, double quantum,
                        const TerrainContext& context) {
  const std::filesystem::path path = context.folder / p.color.path;
  DropletColors colors;
  colors.beneath.resize(input.height.size());
  const char* const channels[] = {"R", "G", "B"};
  for (int c = 0; c < 3; ++c) {
    const Grid<float> values =
        picture_over(path, channels[c], context.domain, input, context.progress);
    for (std::size_t k = 0; k < values.size(); ++k) colors.beneath[k][c] = values.values()[k];
  }
  colors.skin = colors.beneath;
  colors.depth = static_cast<float>(static_cast<double>(p.color_depth) / quantum);
  return colors;
}

void add_color_maps(const DropletColors& colors, int width, int height, TerrainResult& result) {
  const char* const names[] = {"color.red", "color.green", "color.blue"};
  for (int c = 0; c < 3; ++c) {
    Grid<float> map(width, height);
    for (std::size_t k = 0; k < map.size(); ++k) map.values()[k] = colors.skin[k][c];
    result.maps.emplace(names[c], std::move(map));
  }
}

/// One run over a ground.
class DropletRun {
 public:
  DropletRun(const Heightfield& input, const Droplets& parameters, const TerrainContext& context)
      : input_(input),
        parameters_(parameters),
        context_(context),
        ground_(input),
        rates_(droplet_rates(parameters, input.cell, ground_.quantum())),
        radius_cells_(static_cast<double>(parameters.radius) / input.cell) {
    world_.width = input.height.width();
    world_.height = input.height.height();
    world_.cells = ground_.cells();
    world_.closed_border = parameters.closed_border;
    if (!parameters.hardness.empty()) {
      softness_ = softness_of(input, parameters, context);
      world_.softness = softness_.values().data();
    }
    if (!parameters.rain_map.empty())
      rain_share_ = factor_map(input, parameters.rain_map, 1, context);
    if (!parameters.color.empty()) {
      colors_ = colors_of(input, parameters, ground_.quantum(), context);
      world_.colors = &colors_;
    }
  }

  TerrainResult run() {
    if (parameters_.rain > 0) rain();
    return result();
  }

 private:
  void rain() {
    const double area = input_.size().x * input_.size().y;
    const double rain = static_cast<double>(parameters_.rain);
    context_.progress.begin("droplets", rain * area, "drops");
    const double per_cell = rain / showers_of_rain * input_.cell * input_.cell;
    const int side = droplet_tile_side(per_cell);
    DropletTiles tiles(input_, side, rain_share_.empty() ? nullptr : &rain_share_);
    const int at_once =
        std::clamp(static_cast<int>(drops_of_round / (per_cell * side * side)), 1, 8);
    const std::vector<DropletShower> showers =
        droplet_showers(rain, showers_of_rain, context_.seed);
    for (int k = 0; k < showers_of_rain; k += at_once) {
      if (k == showers_of_rain - recorded_showers) start_record(rain);
      for (int n = k; n < k + at_once; ++n)
        tiles.rain(showers[static_cast<std::size_t>(n)], rates_.steps);
      round(tiles, k);
    }
    for (int k = 0; !tiles.empty(); ++k) round(tiles, k);
    removed_ = ground_.quantum() * static_cast<double>(tiles.removed);
    context_.progress.end();
  }

  void round(DropletTiles& tiles, int k) {
    tiles.move(world_, rates_, k, context_.progress);
    ground_.spread_changes(radius_cells_, world_.softness, context_.progress);
  }

  void start_record(double rain) {
    record_.rain = rain * recorded_showers / showers_of_rain;
    record_.passes.resize(input_.height.size());
    record_.speed.resize(input_.height.size());
    world_.passes = record_.passes.data();
    world_.speed = record_.speed.data();
  }

  TerrainResult result() {
    const int width = world_.width;
    const int height = world_.height;
    record_.passes.resize(input_.height.size());
    record_.speed.resize(input_.height.size());
    TerrainResult result{{ground_.eroded(input_), input_.origin, input_.cell}, {}, {}};
    Grid<float> wear = ground_.wear(radius_cells_, world_.softness, context_.progress);
    Grid<float> sediment(width, height);
    for (std::size_t k = 0; k < sediment.size(); ++k)
      sediment.values()[k] = std::max(
          0.0F, result.field.height.values()[k] - input_.height.values()[k] + wear.values()[k]);
    Grid<float> discharge = discharge_map(record_, width, height);
    result.maps.emplace("flow", flow_map(discharge, input_.cell, parameters_.contrast));
    result.maps.emplace("discharge", std::move(discharge));
    result.maps.emplace("velocity", velocity_map(record_, width, height));
    result.maps.emplace("wear", std::move(wear));
    result.maps.emplace("sediment", std::move(sediment));
    if (world_.colors != nullptr) add_color_maps(colors_, width, height, result);
    const double cell_area = input_.cell * input_.cell;
    Balance ground{"ground", volume(input_.height, input_.cell)};
    ground.removed = removed_ * cell_area;
    ground.after = volume(result.field.height, input_.cell);
    ground.moved = ground_.total_wear() * cell_area;
    result.balances.push_back(ground);
    return result;
  }

  const Heightfield& input_;
  const Droplets& parameters_;
  const TerrainContext& context_;
  DropletGround ground_;
  DropletRates rates_;
  double radius_cells_;
  DropletWorld world_;
  DropletColors colors_;
  DropletRecord record_;
  Grid<float> softness_;
  Grid<float> rain_share_;
  double removed_ = 0;  ///< m · cells
};

}  // namespace

Description<Droplets> describe(const Droplets&) {
  using D = Droplets;
  return Description<D>("droplets",
                        "Water erosion by drops that run downhill, take up ground where they are "
                        "fast and lay it down where they slow.")
      .choice("variant", &D::variant, {"slope", "momentum"},
              "How drops move: their direction bends to the slope, or the slope accelerates them "
              "along each axis; the latter's capacity depends on their speed alone.")
      .add("rain", &D::rain, {.unit = "drops/m²", .min = 0, .max = 1e4},
           "How many drops fall. More of them erode more, and take longer.")
      .add("distance", &D::distance, {.unit = "m", .min = 0, .max = 1e6},
           "How far a drop runs at most.")
      .add("inertia", &D::inertia, {.unit = "m", .min = 0, .max = 1e5},
           "The way on which a slope of 45 degrees turns a drop; 0 follows the steepest descent.")
      .add("capacity", &D::capacity, {.unit = "m³", .min = 0, .max = 1e9},
           "What a drop can carry at 1 m/s on a slope of 45 degrees.")
      .add("min_slope", &D::min_slope, {.min = 0, .max = 10},
           "Flatter ground counts as this (rise over run) for what a drop can carry.")
      .add("erosion", &D::erosion, {.unit = "1/m", .min = 0, .max = 1e4},
           "How fast a drop takes up what it could still carry.")
      .add("deposition", &D::deposition, {.unit = "1/m", .min = 0, .max = 1e4},
           "How fast a drop lays down what it cannot carry.")
      .add("evaporation", &D::evaporation, {.unit = "1/m", .min = 0, .max = 1e4},
           "Share of its water that a drop loses on the way.")
      .add("gravity", &D::gravity, {.unit = "m/s²", .min = 0, .max = 1e3}, "Acceleration downhill.")
      .add("drag", &D::drag, {.unit = "1/m", .min = 0, .max = 1e4},
           "Share of its speed that a drop loses on the way.")
      .add("max_speed", &D::max_speed, {.unit = "m/s", .min = 0, .max = 1e4},
           "No drop runs faster.")
      .add("max_drop", &D::max_drop, {.unit = "m", .min = 0, .max = 1e5},
           "A step of the ground between samples higher than this does not accelerate.")
      .add("radius", &D::radius, {.unit = "m", .min = 0, .max = 1e4},
           "Width of a drop's effect; 0: the four samples around it.")
      .add("hardness", &D::hardness, "A map of what resists: white does not erode.")
      .add("hardness_invert", &D::hardness_invert, "Black resists, not white.")
      .add("rain_map", &D::rain_map, "A map of where it rains: white; on black no drops fall.")
      .add("closed_border", &D::closed_border,
           "Drops cannot leave: they run along the border and lay down what they carry.")
      .add("contrast", &D::contrast, {.min = 0, .max = 1},
           "Of the flow map: low shows where most of the water goes after few passes, high only "
           "large streams.")
      .add("color", &D::color, "A picture laid over the terrain, whose colours drops carry along.")
      .add("color_depth", &D::color_depth, {.unit = "m", .min = 1e-3, .max = 1e3},
           "Depth of the ground that has mixed colours: less changes faster.");
}

TerrainResult droplets(const Heightfield& input, const Droplets& parameters,
                       const TerrainContext& context) {
  check_erosion(input, parameters);
  return DropletRun(input, parameters, context).run();
}

}  // namespace wold
