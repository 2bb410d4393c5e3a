// Sliding over 1024 x 1024 cells, in cells times passes per second. Peers on the machine of the
// project's records, 2 cores: the add-on's shaders on llvmpipe 23 to 42 M, A.N.T. Landscape 18 to
// 26 M cell-iterations/s.
//
// Other work on the machine counts in the rates; cell_passes/core_s is per second of one core.
//
// Floors of a pass over what lies in no cache, at 41 GB/s read and written on 2 threads: 8 bytes
// per cell where all is loose (5.1 G cells/s), 16 where it lies on rock (2.6 G). The work on Zen 4
// with 256-bit vectors: two faces of a cell, or the two diagonals of a square, take about 60
// instructions and two divisions per 8 cells where all is loose.

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <ctime>

#include "base/parallel.hpp"
#include "erosion/thermal.hpp"
#include "erosion/thermal_units.hpp"
#include "terrain/operators.hpp"
#include "terrain/steps.hpp"

namespace wold {
namespace {

constexpr double peer = 35e6;       // cell-iterations/s
constexpr double bandwidth = 41e9;  // bytes/s
constexpr int passes = 60;

Heightfield mountains(int resolution) {
  const OperatorList operators = terrain_operators();
  const std::vector<TerrainStep> steps{make_step(operators, "ridged")};
  Progress progress;
  return evaluate({.resolution = resolution}, steps, operators, 1, {}, progress).field;
}

void passes_over(benchmark::State& state, bool layers) {
  const ThreadLimit threads(static_cast<int>(state.range(0)));
  const Heightfield field = mountains(1024);
  const SlideUnits units = slide_units(field, 0, 0);
  const Grid<std::int32_t> height = in_units(field.height, units);
  Progress progress;
  double cells = 0;
  std::clock_t busy = 0;
  for (auto _ : state) {
    SlideGround ground{height, layers ? height : Grid<std::int32_t>{}, {}, units.unit, field.cell};
    const std::clock_t began = std::clock();
    cells += slide(ground, {.cliff = 50}, {0, passes}, false, progress).cell_passes;
    busy += std::clock() - began;
  }
  using benchmark::Counter;
  state.counters["cell_passes/s"] = Counter(cells, Counter::kIsRate);
  state.counters["x_peer"] = Counter(cells / peer, Counter::kIsRate);
  state.counters["of_bandwidth"] = Counter(cells * (layers ? 16 : 8) / bandwidth, Counter::kIsRate);
  state.counters["cell_passes/core_s"] =
      cells * CLOCKS_PER_SEC / static_cast<double>(std::max<std::clock_t>(busy, 1));
  state.SetLabel(fmt::format("peer's figure: {} M cell-iterations/s", peer / 1e6));
}
BENCHMARK_CAPTURE(passes_over, loose, false)->Arg(1)->Arg(2)->UseRealTime();
BENCHMARK_CAPTURE(passes_over, scree_on_rock, true)->Arg(1)->Arg(2)->UseRealTime();

void until_rest(benchmark::State& state, float cliff_angle) {
  const Heightfield field = mountains(static_cast<int>(state.range(0)));
  Thermal parameters;
  parameters.cliff_angle = cliff_angle;
  Progress progress;
  const std::map<std::string, TerrainResult> none;
  const TerrainContext context{1, {field.origin, field.size()}, {}, none, progress};
  for (auto _ : state) benchmark::DoNotOptimize(thermal(field, parameters, context));
}
BENCHMARK_CAPTURE(until_rest, sand, 0.0F)->Arg(1024)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(until_rest, scree, 50.0F)
    ->Arg(1024)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace wold
