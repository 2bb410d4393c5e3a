// The ground in real time: choosing tiles, drawing, and the shade of the land.

#include <benchmark/benchmark.h>
#include <epoxy/gl.h>

#include <array>

#include "gpu/context.hpp"
#include "noise/fractal.hpp"
#include "raster/terrain_drawing.hpp"

namespace wold {
namespace {

/// Mountains of 8 km in 40 km of land.
const Ground& mountains() {
  static const Ground ground = [] {
    const FractalSampler noise({.kind = FractalKind::ridged, .octaves = 9}, 3);
    const auto land = [&](int samples, double size) {
      Heightfield field{Grid<float>(samples, samples), DVec2(-size / 2), size / (samples - 1)};
      for (int j = 0; j < samples; ++j)
        for (int i = 0; i < samples; ++i)
          field.height(i, j) =
              900 * noise((field.origin + field.cell * DVec2(i, j)) / 5000.0, 0).value;
      return field;
    };
    return Ground(land(1025, 8000), land(513, 40000), {}, 1);
  }();
  return ground;
}

/// At `above` metres over the middle.
Camera camera_over(float above) {
  Camera camera;
  camera.position = {0, 0, mountains().base({0, 0}).height + above};
  camera.direction = glm::normalize(Vec3(1, 0.4F, above > 50 ? -0.2F : 0.0F));
  return camera;
}

void choose_tiles(benchmark::State& state) {
  const TerrainLevels levels(mountains());
  const DrawView view = camera_view(camera_over(static_cast<float>(state.range(0))), 640, 360);
  std::size_t tiles = 0;
  for (auto _ : state) tiles = levels.choose(view, {}).tiles.size();
  state.counters["tiles"] = static_cast<double>(tiles);
}
BENCHMARK(choose_tiles)->Arg(2)->Arg(100)->Arg(2000)->Unit(benchmark::kMillisecond);

void draw(benchmark::State& state, bool depth_only) {
  const OffscreenContext context;
  SceneLight light(Sky(), {.size = 0});
  TerrainDrawing terrain(mountains(), {.pixels_per_vertex = 8});
  const int width = depth_only ? 1024 : 640;
  const int height = depth_only ? 1024 : 360;
  const GpuTarget target(width, height, std::array{PixelFormat::rgba16f}, true);
  const DrawView camera = camera_view(camera_over(static_cast<float>(state.range(0))), 640, 360);
  const DrawView view = depth_only ? shadow_view(camera, camera.eye, light.sky().sun_direction(),
                                                 Vec3(500, 500, 2000))
                                   : camera;
  use_reversed_depth();
  glEnable(GL_DEPTH_TEST);
  for (auto _ : state) {
    target.bind();
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    terrain.draw(view, depth_only ? nullptr : &light);
    glFinish();
  }
  state.counters["triangles"] = static_cast<double>(terrain.drawn_triangles());
}
void draw_640x360(benchmark::State& state) {
  draw(state, false);
}
void draw_shadow_map(benchmark::State& state) {
  draw(state, true);
}
BENCHMARK(draw_640x360)->Arg(2)->Arg(100)->Arg(2000)->Unit(benchmark::kMillisecond);
BENCHMARK(draw_shadow_map)->Arg(2)->Unit(benchmark::kMillisecond);

void sun_shadows(benchmark::State& state) {
  SunShadowMap shadows(mountains());
  const Vec3 towards_sun = glm::normalize(Vec3(0.8F, 0.5F, 0.3F));
  for (auto _ : state) shadows.set_sun(towards_sun);
}
BENCHMARK(sun_shadows)->Unit(benchmark::kMillisecond);

void sky_visibility(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(SkyVisibility(mountains()));
}
BENCHMARK(sky_visibility)->Unit(benchmark::kMillisecond);

void update_heights(benchmark::State& state) {
  const OffscreenContext context;
  TerrainDrawing terrain(mountains());
  for (auto _ : state) terrain.update(mountains());
}
BENCHMARK(update_heights)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace wold
