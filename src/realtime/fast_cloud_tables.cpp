#include "realtime/fast_cloud_tables.hpp"

#include <algorithm>

namespace wold {

namespace {

constexpr int shade_levels = 3;
constexpr int shade_size = 512;
constexpr double shade_cell = 50;  // m
constexpr int light_slices = 20;
constexpr double light_cell = 60;      // m
constexpr double light_reach = 105e3;  // m, beyond the farthest clouds
constexpr int layers_a_frame = 2;      // of sunlight, anew where the sun moves

}  // namespace

FastCloudTables::FastCloudTables(int light_size)
    : shade_squares_(shade_size, shade_levels, shade_cell),
      light_squares_(light_size, RingSquares::levels_over(light_size, light_cell, light_reach),
                     light_cell),
      shades_(shade_size, shade_size,
              {.format = PixelFormat::rg16f, .repeat = true, .layers = shade_levels}),
      lights_(light_size, light_size,
              {.format = PixelFormat::r16f,
               .repeat = true,
               .layers = light_slices * light_squares_.levels()}) {}

void FastCloudTables::bake_shades(FastPasses& passes, const RingTarget& target,
                                  const std::vector<RingStrip>& strips,
                                  const std::function<void(const GpuProgram&)>& bind) {
  if (strips.empty()) return;
  const GpuProgram& program = passes[FastPass::shades];
  bind(program);
  draw_strips(program, target, shade_squares_, strips, shades_);
}

void FastCloudTables::bake_lights(FastPasses& passes, const RingTarget& target,
                                  const std::vector<RingStrip>& strips, int first_slice,
                                  int end_slice,
                                  const std::function<void(const GpuProgram&)>& bind) {
  if (strips.empty()) return;
  const GpuProgram& program = passes[FastPass::cloud_lights];
  bind(program);
  for (int slice = first_slice; slice < end_slice; ++slice) {
    program.set("strip_slice", slice);
    draw_strips(program, target, light_squares_, strips, lights_, light_slices, slice);
  }
}

void FastCloudTables::sun_moved() {
  old_shades_ = shade_levels;
  old_lights_ = light_slices * light_squares_.levels();
}

void FastCloudTables::bake(FastPasses& passes, const RingTarget& target, DVec2 eye, DVec2 to_layer,
                           bool at_once, const std::function<void(const GpuProgram&)>& bind) {
  shade_middle_ = eye + to_layer;
  light_middle_ = eye;
  const int layers = light_slices * light_squares_.levels();
  std::vector<RingStrip> changed = shade_squares_.move_to(shade_middle_);
  for (int k = at_once ? old_shades_ : std::min(old_shades_, 1); k > 0; --k, --old_shades_) {
    next_shade_ = (next_shade_ + 1) % shade_levels;
    changed.push_back(shade_squares_.whole(next_shade_));
  }
  bake_shades(passes, target, changed, bind);
  bake_lights(passes, target, light_squares_.move_to(light_middle_), 0, light_slices, bind);
  const int again = at_once ? old_lights_ : std::min(old_lights_, layers_a_frame);
  for (int k = again; k > 0; --k, --old_lights_) {
    next_light_ = (next_light_ + 1) % layers;
    const int slice = next_light_ % light_slices;
    bake_lights(passes, target, {light_squares_.whole(next_light_ / light_slices)}, slice,
                slice + 1, bind);
  }
}

void FastCloudTables::bind(const GpuProgram& program, int unit) const {
  shades_.bind(unit);
  program.set("cloud_shades", unit);
  lights_.bind(unit + 1);
  program.set("cloud_lights", unit + 1);
  program.set("shade_cell", static_cast<float>(shade_cell));
  program.set("shade_levels", shade_levels);
  program.set("shade_middle", Vec2(shade_middle_));
  program.set("light_cell", static_cast<float>(light_cell));
  program.set("light_levels", light_squares_.levels());
  program.set("light_slices", light_slices);
  program.set("light_middle", Vec2(light_middle_));
}

}  // namespace wold
