// Rendering of scenes/forest.toml, and building of a scene with 100,000 trees.
//
// `embree` is the share of tracing time inside Embree: what is left is ours to make faster. The
// share is measured with the processor's time stamp counter around each query.

#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include <chrono>

#include "scene/build.hpp"

namespace wold {
namespace {

using Clock = std::chrono::steady_clock;

double since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

double peak_gigabytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) * 1024 / 1e9;
}

Scene forest(std::vector<std::string> overrides) {
  return read_scene(WOLD_SOURCE_DIR "/scenes/forest.toml", overrides);
}

/// Camera paths per second on all cores, and time from the start to the first sample of every
/// pixel.
void render_forest(benchmark::State& state) {
  const auto start = Clock::now();
  const Scene scene = forest({"render.size=[640, 360]"});
  Progress silent;
  const BuiltScene built = build(scene, "", silent);
  const double build_seconds = since(start);
  const CameraRays camera(built.camera, 640, 360);
  const std::uint32_t samples = 4;
  std::uint32_t first = 0;
  RenderCounts sum;
  double seconds = 0;
  double first_pass = 0;
  for (auto _ : state) {
    Film film(640, 360);
    const auto begin = Clock::now();
    const RenderCounts counts = trace_picture(*built.rays, camera, scene.render,
                                              {{first, first + samples}, 1, true}, film, silent);
    const double time = since(begin);
    state.SetIterationTime(time);
    if (first == 0) first_pass = counts.first_pass_seconds;
    seconds += time;
    sum.paths += counts.paths;
    sum.rays += counts.rays;
    sum.embree_ticks += counts.embree_ticks;
    sum.all_ticks += counts.all_ticks;
    first += samples;
  }
  state.counters["paths/s"] = static_cast<double>(sum.paths) / seconds;
  state.counters["rays/s"] = static_cast<double>(sum.rays) / seconds;
  state.counters["rays/path"] = static_cast<double>(sum.rays) / static_cast<double>(sum.paths);
  state.counters["embree"] =
      static_cast<double>(sum.embree_ticks) / static_cast<double>(sum.all_ticks);
  state.counters["scene_s"] = build_seconds;
  state.counters["first_picture_s"] = build_seconds + first_pass;
  state.counters["triangles"] = static_cast<double>(built.rays->all_triangles());
  state.counters["peak_GB"] = peak_gigabytes();
  state.SetLabel("Cycles 3.4.1, 400 trees, 4 bounces: 0.17 M paths/s on 2 threads");
}
BENCHMARK(render_forest)->UseManualTime()->Iterations(5)->Unit(benchmark::kSecond);

/// 100,000 trees of 5 models: time to build all that a render needs.
void build_100k_trees(benchmark::State& state) {
  const std::string text = R"(
[terrain]
size = 3200
resolution = 513
[[terrain.step]]
op = "fbm"
height = 60
feature_size = 1500
[[species]]
name = "birch"
plant = "plants/birch.lsys"
height = [9, 16]
radius = 0.5
models = 5
[[scatter]]
species = { birch = 1 }
density = 0.0098
slope = [0, 80]
)";
  Progress silent;
  double plants = 0;
  for (auto _ : state) {
    const BuiltScene built = build(parse_scene(text, "100k", WOLD_SOURCE_DIR), "", silent);
    plants = static_cast<double>(built.world->instances.size());
  }
  state.counters["trees"] = plants;
  state.counters["peak_GB"] = peak_gigabytes();
}
BENCHMARK(build_100k_trees)->Iterations(1)->UseRealTime()->Unit(benchmark::kSecond);

}  // namespace
}  // namespace wold
