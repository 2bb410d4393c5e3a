// Droplets on two threads, in steps (one drop moved by one cell, with its exchange) per second of
// the fastest run. Peer: the add-on of the sources with its own shaders on the same two cores, 52
// to 59 M steps/s, not conserving, not deterministic. The goal is 5 times that, 275 M.
//
// Floor on Zen 4 with 512-bit vectors, 16 drops, as counted: about 190 vector operations of one
// cycle each (two halves on two units), two square roots and a division of 10 cycles: 220 cycles;
// per drop 4 loads to gather and 4 loads and 2 stores to write back with their additions: 6 cycles.
// 20 core cycles per step; "share" is that over the measured, for a core at 3.7 GHz (assumed: the
// counter does not tell). Measured in one tile: 19 to 20. A whole run, measured beside other
// programs: 27 of each thread's time, of which 2 for the maps and 3 for rain, brush and slides;
// threads wait for each other's last tiles 2 % of the time. One tile is short enough to be often
// undisturbed.

#include <benchmark/benchmark.h>

#include <chrono>

#include "base/hash.hpp"
#include "base/parallel.hpp"
#include "erosion/droplet_rates.hpp"
#include "erosion/droplet_run.hpp"
#include "terrain/ridged.hpp"

namespace wold {
namespace {

constexpr double peer = 55e6;             // steps/s
constexpr double goal = 275e6;            // steps/s
constexpr double floor_cycles = 20;       // per step and thread
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
  double seconds = 1e30;
  for (auto _ : state) {
    const auto began = std::chrono::steady_clock::now();
    DropletRun run(mountains, parameters, context);
    run.rain();
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - began;
    best = std::max(best, static_cast<double>(run.steps()) / took.count());
    seconds = std::min(seconds, took.count());
  }
  state.counters["Msteps/s"] = best / 1e6;
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
