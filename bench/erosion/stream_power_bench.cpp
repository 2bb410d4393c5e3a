// Steps of stream power over grids of 512² to 2048² samples, with routing over pits, in million
// cell-steps per second of the fastest step; and drainage of given ground. Peer: fastscapelib 0.2.2
// on the machine of the project's records, one thread, routing and sinks included: 2.0 M.
//
// Every step counts everything anew: directions, donors, basins of pits, order, areas, erosion,
// diffusion. "noise" starts from white noise (a pit in every ninth sample, as the peer's example
// does), "range" from ground that has eroded for 20 steps (some hundred pits).
//
// Floor in bytes: per cell and step the passes read or write height 6 times, direction and donors
// 5, 2 and count, order, cosine, erodibility, uplift, talus once or twice: about 80 bytes from
// memory for grids beyond the cache, or 41.6 GB/s / 80 B = 520 M cell-steps/s on 2 threads. Floor
// in cycles: the chains of the order are walked down once and up once; a step of a chain waits for
// the direction and the height before (about 2 x 14 cycles of the second cache) and each sample has
// 8 neighbours to compare (about 6 cycles with vectors of 8): some 35 cycles of one core, near 200
// M on two. The counters say which share is reached.

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "base/hash.hpp"
#include "base/parallel.hpp"
#include "erosion/drainage_depressions.hpp"
#include "erosion/stream_power_solver.hpp"
#include "noise/fractal.hpp"

namespace wold {
namespace {

constexpr double peer_rate = 2.0e6;
constexpr double floor_bytes = 80;
constexpr double memory_rate = 41.6e9;

Grid<float> white_noise(int size) {
  Grid<float> height(size, size);
  for (int j = 0; j < size; ++j)
    for (int i = 0; i < size; ++i) height(i, j) = uniform(random_bits(1, i, j));
  return height;
}

Grid<float> hills(int size) {
  Grid<float> height(size, size);
  Progress progress;
  fill_fractal(height, {.hurst = 0.9F}, {0, 0}, 10.0 / 3000, 3, progress);
  for (float& h : height.values()) h *= 100;
  return height;
}

template <class Work>
double seconds_of(const Work& work) {
  const auto began = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
}

void steps(benchmark::State& state, bool noise, double deposition) {
  const auto size = static_cast<int>(state.range(0));
  const ThreadLimit threads(static_cast<int>(state.range(1)));
  Progress progress;
  Grid<float> height = noise ? white_noise(size) : hills(size);
  StreamPowerSolver solver(10, {.deposition = deposition, .diffusivity = 0.002},
                           {Grid<float>(size, size, 1e-5F),
                            Grid<float>(size, size, 1e-3F),
                            Grid<float>(size, size, 0.7F),
                            {}},
                           StreamPowerMesh({height, {0, 0}, 10}, 1, false), 1, progress);
  const Grid<float> start = height;
  if (!noise)
    for (int s = 0; s < 20; ++s) solver.step(height, 1e4);
  double best = 1e9;
  for (auto _ : state) {
    if (noise) height = start;
    best = std::min(best, seconds_of([&] { solver.step(height, 1e4); }));
  }
  const double rate = size * static_cast<double>(size) / best;
  state.counters["Mcell-steps/s"] = rate / 1e6;
  state.counters["x_fastscapelib"] = rate / peer_rate;
  state.counters["of_memory_floor_%"] = 100 * rate * floor_bytes / memory_rate;
  state.counters["pits"] = solver.pits();
}

void fill(benchmark::State& state) {
  const auto size = static_cast<int>(state.range(0));
  const Grid<float> height = hills(size);
  Progress progress;
  double best = 1e9;
  for (auto _ : state)
    best = std::min(
        best, seconds_of([&] {
          benchmark::DoNotOptimize(fill_depressions(height, FillSurface::sloping, progress));
        }));
  state.counters["Mcells/s"] = size * static_cast<double>(size) / best / 1e6;
}

void register_all() {
  const auto shapes = [](benchmark::internal::Benchmark* b) {
    b->ArgNames({"size", "threads"})->Unit(benchmark::kMillisecond)->UseRealTime();
    for (const int size : {512, 1024, 2048})
      for (const int threads : {1, 2}) b->Args({size, threads});
  };
  const auto add = [&](const char* name, bool noise, double deposition) {
    benchmark::RegisterBenchmark(name, [=](benchmark::State& s) {
      steps(s, noise, deposition);
    })->Apply(shapes);
  };
  add("stream_power_range", false, 0);
  add("stream_power_range_with_deposition", false, 0.5);
  add("stream_power_noise", true, 0);
  benchmark::RegisterBenchmark("fill_depressions", fill)->Arg(1024)->Unit(benchmark::kMillisecond);
}

[[maybe_unused]] const bool registered = (register_all(), true);

}  // namespace
}  // namespace wold
