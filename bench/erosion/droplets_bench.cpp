// Droplets on two threads, in steps (one drop moved by one cell, with its exchange) per second of
// the fastest run. Peer: the add-on of the sources with its own shaders on the same two cores, 52
// to 59 M steps/s, not conserving, not deterministic. The goal is 5 times that, 275 M.
//
// Floor on Zen 4, 512-bit vectors, by operations counted in the program and their throughput as
// measured: two vectors, 32 drops, take 115 multiplications, fused ones and comparisons (with four
// square roots of 10 cycles and two divisions of 6) on one pair of units, and beside them 115
// additions, conversions and minima on the other, one per cycle each; 60 operations on integers and
// 30 shuffles go on either: 160 cycles, 5 per drop. Ground per drop: 3 loads and a store to gather,
// 9 loads and 4 stores to write back, 3 loads or 2 stores per cycle: 4.5. 10 core cycles per step;
// "share" is that over the measured, for a core at 3.7 GHz (as measured by a chain of additions).
// A tile's 512 KiB come from the third cache once per 150 000 steps, 7 bytes per step both ways.
//
// Measured in one tile: 16.3 cycles (9.2 arithmetic, 5 writing back), 19.5 while recorded for maps.
// A whole run: 22 to 24 of each thread's time, 20 of them in tiles (misses of caches, beginnings
// and ends of drops), the rest rain, brush and slides; by the time of each tile, two threads wait
// for each other 3 %. Threads' own time ("Msteps/s/core") tells most where other programs run.

#include <benchmark/benchmark.h>

#include <chrono>
#include <ctime>

#include "base/hash.hpp"
#include "base/parallel.hpp"
#include "erosion/droplet_rates.hpp"
#include "erosion/droplet_run.hpp"
#include "terrain/ridged.hpp"

namespace wold {
namespace {

constexpr double peer = 55e6;             // steps/s
constexpr double goal = 275e6;            // steps/s
constexpr double floor_cycles = 10;       // per step and thread
constexpr double core_frequency = 3.7e9;  // Hz

// Samples a side are the argument; 4 km.
void default_droplets(benchmark::State& state) {
  const ThreadLimit threads(2);
  const auto samples = static_cast<int>(state.range(0));
  Progress progress;
  const std::map<std::string, TerrainResult> none;
  const double size = 4000;
  const Heightfield plane{Grid<float>(samples, samples), DVec2(0), size / (samples - 1)};
  const TerrainContext context{1, {plane.origin, plane.size()}, {}, none, progress};
  const Heightfield mountains = ridged(plane, RidgedGround{}, context);
  Droplets parameters;
  double best = 0;
  double best_of_core = 0;
  double seconds = 1e30;
  for (auto _ : state) {
    const auto began = std::chrono::steady_clock::now();
    const std::clock_t began_cores = std::clock();
    DropletRun run(mountains, parameters, context);
    run.rain();
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - began;
    best = std::max(best, static_cast<double>(run.steps()) / took.count());
    seconds = std::min(seconds, took.count());
    const double of_cores = static_cast<double>(std::clock() - began_cores) / CLOCKS_PER_SEC;
    best_of_core = std::max(best_of_core, static_cast<double>(run.steps()) / of_cores);
  }
  state.counters["Msteps/s"] = best / 1e6;
  state.counters["Msteps/s/core"] = best_of_core / 1e6;
  state.counters["x_peer"] = best / peer;
  state.counters["of_goal"] = best / goal;
  state.counters["share"] = best * floor_cycles / (2 * core_frequency);
  state.counters["seconds"] = seconds;
}
BENCHMARK(default_droplets)->ArgName("samples")->Arg(1024)->Unit(benchmark::kMillisecond);

// One tile on one thread.
void one_tile(benchmark::State& state) {
  const int samples = 256;
  Progress progress;
  const std::map<std::string, TerrainResult> none;
  const Heightfield plane{Grid<float>(samples, samples), DVec2(0), 4};
  const TerrainContext context{1, {plane.origin, plane.size()}, {}, none, progress};
  const Heightfield mountains = ridged(plane, RidgedGround{}, context);
  DropletGround ground(mountains);
  const DropletRates rates = droplet_rates(Droplets{}, plane.cell, ground.quantum());
  DropletWorld world;
  world.width = world.height = samples;
  world.stride = droplet_stride(samples);
  world.cells = ground.cells();
  std::vector<Drop> drops(512);
  for (std::size_t k = 0; k < drops.size(); ++k) {
    const std::uint64_t bits = random_bits(1, k);
    drops[k].cell =
        IVec2(static_cast<int>(64 + bits % 128), static_cast<int>(64 + (bits >> 32U) % 128));
    drops[k].left = rates.steps;
    drops[k].direction = {1, 0};
  }
  const std::vector<DropletCell> at_first(ground.cells(), ground.cells() + world.stride * samples);
  double best = 0;
  for (auto _ : state) {
    std::copy(at_first.begin(), at_first.end(), ground.cells());
    DropletTally tally;
    const auto began = std::chrono::steady_clock::now();
    walk_droplets(world, rates, {0, 0, samples, samples}, drops, tally, progress);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - began;
    best = std::max(best, static_cast<double>(tally.steps) / took.count());
    state.counters["steps"] = static_cast<double>(tally.steps);
  }
  state.counters["Msteps/s"] = best / 1e6;
  state.counters["cycles/step"] = core_frequency / best;
  state.counters["of_goal"] = best / (goal / 2);
  state.counters["share"] = best * floor_cycles / core_frequency;
}
BENCHMARK(one_tile)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace wold
