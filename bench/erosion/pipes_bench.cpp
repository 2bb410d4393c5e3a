// Pipes over 1024² samples, in cells times steps per second, the sediment, its exchange, rain and
// slides with it. Peers on the machine of the project's records (docs: peers): the shaders of a
// Blender add-on on llvmpipe 8 to 16 M cell-iterations/s, A.N.T. Landscape (numpy) 7 M.
//
// Floor: a step reads 7 values of a cell (ground, ease, change, depth, sediment, two pipes) and
// writes 5: 48 bytes, over memory at 41 GB/s 850 M cells/s; with momentum 4 more. Arithmetic is nearer: 3 divisions and 4
// roots per cell, and some 120 other operations, in vectors of 8.

#include <benchmark/benchmark.h>

#include <cmath>

#include "base/parallel.hpp"
#include "erosion/dissolution.hpp"
#include "erosion/layers.hpp"
#include "erosion/pipes.hpp"

namespace wold {
namespace {

constexpr double bandwidth = 41e9;  // bytes/s
constexpr double bytes_per_cell_step = 48;
constexpr double peer = 16e6;  // cell-iterations/s

Heightfield hills(int size) {
  Heightfield field{Grid<float>(size, size), {0, 0}, 4};
  for (int j = 0; j < size; ++j)
    for (int i = 0; i < size; ++i)
      field.height(i, j) = static_cast<float>(300 + 80 * std::sin(i / 70.0) * std::cos(j / 90.0) +
                                              12 * std::sin(i / 23.0 + j / 31.0));
  return field;
}

template <class Work, class T>
void measure(benchmark::State& state, Work work, const T& parameters, int size) {
  const ThreadLimit threads(static_cast<int>(state.range(0)));
  const Heightfield land = hills(size);
  const std::map<std::string, TerrainResult> none;
  double steps = 0;
  for (auto _ : state) {
    Progress progress([&](const ProgressReport& report) {
      if (report.finished && report.unit == "cell steps") steps += report.total;
    });
    const TerrainContext context{1, {land.origin, land.size()}, {}, none, progress};
    benchmark::DoNotOptimize(work(land, parameters, context));
  }
  const auto rate = [](double amount) {
    return benchmark::Counter(amount, benchmark::Counter::kIsRate);
  };
  state.counters["cell_steps/s"] = rate(steps);
  state.counters["x_peer"] = rate(steps / peer);
  state.counters["of_memory"] = rate(steps * bytes_per_cell_step / bandwidth);
}

void pipes_one_grid(benchmark::State& state, bool momentum) {
  Pipes p;
  p.momentum = momentum;
  p.start_cell = 1;  // below the samples: one grid
  p.duration = 0.02F;
  p.lakes = false;
  measure(state, pipes, p, static_cast<int>(state.range(1)));
}
BENCHMARK_CAPTURE(pipes_one_grid, plain, false)
    ->ArgNames({"threads", "size"})
    ->ArgsProduct({{1, 2}, {256, 512, 1024, 2048}})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(pipes_one_grid, momentum, true)
    ->ArgNames({"threads", "size"})
    ->ArgsProduct({{1, 2}, {1024}})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

void pipes_default(benchmark::State& state) {
  measure(state, pipes, Pipes{}, static_cast<int>(state.range(1)));
}
BENCHMARK(pipes_default)
    ->ArgNames({"threads", "size"})
    ->ArgsProduct({{2}, {512, 1024}})
    ->UseRealTime()
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

void dissolution_default(benchmark::State& state) {
  measure(state, dissolution, Dissolution{}, 512);
}
BENCHMARK(dissolution_default)
    ->ArgName("threads")
    ->Arg(2)
    ->UseRealTime()
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace wold
