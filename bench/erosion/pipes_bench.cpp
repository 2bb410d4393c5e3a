// Pipes over 1024² samples, in cells times steps per second, the sediment, its exchange, rain and
// slides with it. Peers on the machine of the project's records (docs: peers): the shaders of a
// Blender add-on on llvmpipe 8 to 16 M cell-iterations/s, A.N.T. Landscape (numpy) 7 M.
//
// Floor: a step reads 7 values of a cell (ground, ease, change, depth, sediment, two pipes) and
// writes 5, with momentum 9 and 7: 64 bytes, over memory at 41 GB/s 640 M cells/s. Arithmetic is
// nearer: 3 divisions and 4 roots per cell, and some 120 other operations, in vectors of 8.

#include <benchmark/benchmark.h>

#include <cmath>

#include "base/parallel.hpp"
#include "erosion/dissolution.hpp"
#include "erosion/layers.hpp"
#include "erosion/pipes.hpp"
#include "erosion/pipes_solver.hpp"

namespace wold {

using namespace pipes_detail;

namespace {

constexpr double bandwidth = 41e9;  // bytes/s
constexpr double bytes_per_cell_step = 64;
constexpr double peer = 16e6;  // cell-iterations/s

Heightfield hills(int size) {
  Heightfield field{Grid<float>(size, size), {0, 0}, 4};
  for (int j = 0; j < size; ++j)
    for (int i = 0; i < size; ++i)
      field.height(i, j) = static_cast<float>(300 + 80 * std::sin(i / 70.0) * std::cos(j / 90.0) +
                                              12 * std::sin(i / 23.0 + j / 31.0));
  return field;
}

benchmark::Counter rate(double amount) {
  return benchmark::Counter(amount, benchmark::Counter::kIsRate);
}

PipeSolver rained_on(const Pipes& parameters, int size, Progress& progress) {
  const Grid<Grains> none(size, size);
  return PipeSolver({hills(size),
                     Grid<float>(size, size, 1),
                     Grid<float>(size, size, parameters.rain / 1000 / 3600),
                     none,
                     none,
                     none,
                     {}},
                    parameters, progress);
}

void pipes_one_grid(benchmark::State& state, bool momentum) {
  const ThreadLimit threads(static_cast<int>(state.range(0)));
  const auto size = static_cast<int>(state.range(1));
  Pipes p;
  p.momentum = momentum;
  Progress progress;
  PipeSolver solver = rained_on(p, size, progress);
  solver.run(60, progress);
  const int before = solver.steps();
  for (auto _ : state) solver.run(20, progress);
  const double steps = 1.0 * (solver.steps() - before) * size * size;
  state.counters["cell_steps/s"] = rate(steps);
  state.counters["x_peer"] = rate(steps / peer);
  state.counters["of_memory"] = rate(steps * bytes_per_cell_step / bandwidth);
}
BENCHMARK_CAPTURE(pipes_one_grid, momentum, true)
    ->ArgNames({"threads", "size"})
    ->ArgsProduct({{1, 2}, {256, 512, 1024, 2048}})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(pipes_one_grid, plain, false)
    ->ArgNames({"threads", "size"})
    ->ArgsProduct({{1, 2}, {1024}})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

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
  if (steps > 0) state.counters["cell_steps/s"] = rate(steps);
}

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
