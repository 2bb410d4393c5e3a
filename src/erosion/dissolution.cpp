#include "erosion/dissolution.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/parallel.hpp"
#include "erosion/dissolution_rows.hpp"
#include "erosion/ghost_grid.hpp"
#include "erosion/ground.hpp"
#include "erosion/pipes_input.hpp"

namespace wold {

using namespace dissolution_detail;
using namespace pipes_detail;

namespace {

constexpr float wall = 1e6F;          // m, height of ground beyond a closed border
constexpr float drop_beyond = 0.01F;  // of a cell: fall of the ground beyond an open border
constexpr float least_drop = 1e-4F;   // of a cell: flat ground dissolves as if it fell by that
constexpr int rows_per_task = 16;

class SlowWater {
 public:
  SlowWater(const Heightfield& input, const Dissolution& p, const TerrainContext& context);

  void run();
  TerrainResult result() const;

 private:
  WaterRow row(int j) const {
    return {ground_.row(j),    change_.row(j), depth_.row(j),
            dissolved_.row(j), give_.row(j),   load_.row(j)};
  }
  GroundRow ground_row(int j) const { return {ground_.row(j), change_.row(j), taken_.row(j)}; }
  void set_ghosts();
  void set_border(float beyond);
  void weather_and_exchange(float turn);
  WeatherConstants weather_of(float turn) const;
  void move();
  Sums lost_over_border() const;

  const Heightfield& input_;
  const Dissolution& p_;
  const TerrainContext& context_;
  int width_;
  int height_;
  bool periodic_;
  double step_ = 1;  ///< s
  GhostGrid<float> ground_;
  GhostGrid<Grains> change_;
  GhostGrid<Grains> next_change_;
  GhostGrid<Grains> taken_;
  GhostGrid<Grains> depth_;
  GhostGrid<Grains> dissolved_;
  GhostGrid<Grains> next_depth_;
  GhostGrid<Grains> next_dissolved_;
  GhostGrid<float> give_;
  GhostGrid<float> load_;
  Grid<float> ease_;
  Grid<float> rain_;
  Sums sums_;
  double water_before_ = 0;  ///< grains
};

SlowWater::SlowWater(const Heightfield& input, const Dissolution& p, const TerrainContext& context)
    : input_(input),
      p_(p),
      context_(context),
      width_(input.height.width()),
      height_(input.height.height()),
      periodic_(p.border == WaterBorder::periodic),
      ease_(ease_of(input, p.hardness, p.hardness_invert, context)),
      rain_(factor_map(input, p.rain_map, 1, context)) {
  // A grid at a time: with many samples each takes a while.
  const auto make = [&]<class T>(GhostGrid<T>& grid) {
    grid = GhostGrid<T>(width_, height_);
    context.progress.advance(0);
  };
  for (GhostGrid<Grains>* grid :
       {&change_, &next_change_, &taken_, &depth_, &dissolved_, &next_depth_, &next_dissolved_})
    make(*grid);
  for (GhostGrid<float>* grid : {&ground_, &give_, &load_}) make(*grid);
  const Grid<float> water = depth_map(input, p.water, context);
  for (int j = 0; j < height_; ++j) {
    context.progress.advance(0);
    for (int i = 0; i < width_; ++i) {
      ground_.row(j)[i] = input.height(i, j);
      depth_.row(j)[i] = static_cast<Grains>(water(i, j) * grains_per_metre);
      water_before_ += depth_.row(j)[i];
    }
    ground_.fill_sides(j, periodic_);
  }
  ground_.fill_ends(periodic_);
}

void SlowWater::set_ghosts() {
  for (int j = 0; j < height_; ++j) {
    depth_.fill_sides(j, periodic_);
    dissolved_.fill_sides(j, periodic_);
  }
  depth_.fill_ends(periodic_);
  dissolved_.fill_ends(periodic_);
  // Beyond the border there is a wall, or dry ground a little lower; it gives nothing back.
  set_border(p_.border == WaterBorder::closed ? wall
                                              : -drop_beyond * static_cast<float>(input_.cell));
}

/// The ground beyond the border is higher by that than the ground inside, and dry.
void SlowWater::set_border(float beyond) {
  if (periodic_) return;
  const auto set = [&](int j, int i, int inner_j, int inner_i) {
    ground_.row(j)[i] = ground_.row(inner_j)[inner_i] + beyond;
    depth_.row(j)[i] = 0;
  };
  for (int j = -1; j <= height_; ++j) {
    const int inner = std::clamp(j, 0, height_ - 1);
    set(j, -1, inner, 0);
    set(j, width_, inner, width_ - 1);
  }
  for (int i = 0; i < width_; ++i) {
    set(-1, i, 0, i);
    set(height_, i, height_ - 1, i);
  }
}

WeatherConstants SlowWater::weather_of(float turn) const {
  const double hours = step_ / 3600;
  const auto share = [&](float rate) {
    return static_cast<float>(-std::expm1(-static_cast<double>(rate) * hours));
  };
  WeatherConstants c;
  c.rain = static_cast<float>(static_cast<double>(p_.rain) / 1000 * hours) * grains_per_metre;
  c.turn = turn;
  c.evaporated = share(p_.evaporation);
  c.dry = p_.evaporation > 0 ? static_cast<Grains>(p_.dry_depth * grains_per_metre) : 0;
  c.saturation = p_.saturation;
  c.dissolving = share(p_.dissolving);
  c.depositing = share(p_.depositing);
  c.least_drop = least_drop * static_cast<float>(input_.cell);
  return c;
}

void SlowWater::weather_and_exchange(float turn) {
  const WeatherConstants constants = weather_of(turn);
  set_border(0);  // it pulls nothing down
  std::vector<Sums> sums(static_cast<std::size_t>(height_));
  parallel_for(
      0, height_,
      [&](int j) {
        context_.progress.advance(0);
        sums[static_cast<std::size_t>(j)] =
            weather({ground_row(j - 1), ground_row(j), ground_row(j + 1), rain_.row(j).data(),
                     ease_.row(j).data(), depth_.row(j), dissolved_.row(j), taken_.row(j)},
                    width_, constants);
        taken_.fill_sides(j, periodic_);
      },
      rows_per_task);
  taken_.fill_ends(periodic_);
  for (const Sums& s : sums) sums_ += s;
  parallel_for(
      0, height_,
      [&](int j) {
        context_.progress.advance(0);
        wear(ground_row(j - 1), ground_row(j), ground_row(j + 1), next_change_.row(j), width_);
        next_change_.fill_sides(j, periodic_);
      },
      rows_per_task);
  std::swap(change_, next_change_);
  change_.fill_ends(periodic_);
}

void SlowWater::move() {
  set_ghosts();
  parallel_for(
      0, height_,
      [&](int j) {
        context_.progress.advance(0);
        offer(row(j - 1), row(j), row(j + 1), give_.row(j), load_.row(j), width_);
        if (periodic_) {
          give_.fill_sides(j, true);
          load_.fill_sides(j, true);
        }
      },
      rows_per_task);
  if (periodic_) {
    give_.fill_ends(true);
    load_.fill_ends(true);
  } else {
    sums_ += lost_over_border();
  }
  parallel_for(
      0, height_,
      [&](int j) {
        context_.progress.advance(0);
        flow(row(j - 1), row(j), row(j + 1), next_depth_.row(j), next_dissolved_.row(j), width_);
      },
      rows_per_task);
  std::swap(depth_, next_depth_);
  std::swap(dissolved_, next_dissolved_);
}

Sums SlowWater::lost_over_border() const {
  Sums sums;
  const auto outside = [&](int i, int j) { return i < 0 || j < 0 || i >= width_ || j >= height_; };
  const auto lose = [&](int i, int j) {
    for (int dj = -1; dj <= 1; ++dj) {
      for (int di = -1; di <= 1; ++di) {
        if (!outside(i + di, j + dj)) continue;
        const Flow out = flow_between(row(j), i, row(j + dj), i + di, di != 0 && dj != 0 ? 2 : 1);
        sums.water_out += out.water;
        sums.ground_out += out.dissolved;
      }
    }
  };
  for (int j = 0; j < height_; ++j) {
    const int step = j == 0 || j == height_ - 1 ? 1 : width_ - 1;
    for (int i = 0; i < width_; i += step) lose(i, j);
  }
  return sums;
}

void SlowWater::run() {
  const double seconds = 3600 * static_cast<double>(p_.duration);
  const double steps = std::ceil(seconds * static_cast<double>(p_.speed) / input_.cell);
  if (steps < 1) return;
  step_ = seconds / steps;
  const ProgressStage stage(context_.progress, "water",
                            steps * static_cast<double>(input_.height.size()), "cell steps");
  for (double k = 0; k < steps; ++k) {
    // What is less than a grain rains by turns.
    weather_and_exchange(static_cast<float>(std::fmod(k * 0.6180339887498949, 1.0)));
    move();
    context_.progress.advance(static_cast<double>(input_.height.size()));
  }
}

TerrainResult SlowWater::result() const {
  Grid<Grains> change(width_, height_);
  Grid<Grains> dissolved(width_, height_);
  TerrainResult out;
  Grid<float> water(width_, height_);
  double water_after = 0;
  for (int j = 0; j < height_; ++j) {
    context_.progress.advance(0);
    for (int i = 0; i < width_; ++i) {
      change(i, j) = change_.row(j)[i];
      dissolved(i, j) = dissolved_.row(j)[i];
      water(i, j) = metres_per_grain * static_cast<float>(depth_.row(j)[i]);
      water_after += depth_.row(j)[i];
    }
  }
  const double per_grain = input_.cell * input_.cell * static_cast<double>(metres_per_grain);
  Balance earth{.quantity = "ground"};
  earth.before = volume(input_.height, input_.cell);
  earth.removed = per_grain * static_cast<double>(sums_.ground_out);
  earth.moved = per_grain * static_cast<double>(sums_.taken_up);
  out.field = changed_ground(input_, change, dissolved, out.maps, context_.progress);
  earth.after = volume(out.field.height, input_.cell);
  Balance wet{.quantity = "water"};
  wet.before = per_grain * water_before_;
  wet.added = per_grain * static_cast<double>(sums_.water_in);
  wet.removed = per_grain * static_cast<double>(sums_.water_out);
  wet.after = per_grain * water_after;
  wet.moved = wet.before + wet.added;
  out.balances = {earth, wet};
  out.maps["water"] = std::move(water);
  return out;
}

}  // namespace

Description<Dissolution> describe(const Dissolution&) {
  return Description<Dissolution>("dissolution",
                                  "Slow water dissolves the ground and lays it down where it dries "
                                  "up: smooth beds of lakes and slow rivers.")
      .add("duration", &Dissolution::duration, {.unit = "h", .min = 0, .max = 1e5},
           "How long it rains and flows.")
      .add("rain", &Dissolution::rain, {.unit = "mm/h", .min = 0, .max = 1000}, "How much.")
      .add("rain_map", &Dissolution::rain_map,
           "Map that multiplies the rain (0 to 1): a step, a map, a picture.")
      .add("water", &Dissolution::water, "Map of the water's depth (m) at the beginning.")
      .add("evaporation", &Dissolution::evaporation, {.unit = "1/h", .min = 0, .max = 1000},
           "Share of the water's depth that evaporates in an hour.")
      .add("dry_depth", &Dissolution::dry_depth, {.unit = "m", .min = 0, .max = 10},
           "Less water than this evaporates at once.")
      .add("saturation", &Dissolution::saturation, {.min = 0, .max = 10},
           "Ground that water can hold, m per m of depth.")
      .add("dissolving", &Dissolution::dissolving, {.unit = "1/h", .min = 0, .max = 1e4},
           "How fast water takes up what it lacks.")
      .add("depositing", &Dissolution::depositing, {.unit = "1/h", .min = 0, .max = 1e4},
           "How fast water lays down what it holds too much.")
      .add("speed", &Dissolution::speed, {.unit = "m/s", .min = 0.0001, .max = 10},
           "How fast water creeps.")
      .choice(
          "border", &Dissolution::border, {"open", "closed", "periodic"},
          "What happens to water at the border: it leaves, is held, or comes in again opposite.")
      .add("hardness", &Dissolution::hardness,
           "Map of what resists (0 to 1, white does not wear): a step, a map, a picture.")
      .add("hardness_invert", &Dissolution::hardness_invert, "Whether black is hard instead.");
}

TerrainResult dissolution(const Heightfield& input, const Dissolution& parameters,
                          const TerrainContext& context) {
  check_erosion(input, parameters);
  const ProgressStage stage(context.progress, "dissolution", 0, "");
  SlowWater water(input, parameters, context);
  water.run();
  return water.result();
}

}  // namespace wold
