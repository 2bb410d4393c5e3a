// Plants scattered per second on flat ground, planning of the spacing included.
#include "forest/scatter.hpp"

#include <benchmark/benchmark.h>

namespace wold {
namespace {

Heightfield flat(double side) {
  Heightfield ground;
  ground.height = Grid<float>(513, 513);
  ground.cell = side / 512;
  ground.origin = DVec2(-side / 2);
  return ground;
}

void scatter_birch_and_fern(benchmark::State& state) {
  SpeciesSettings birch;
  birch.name = "birch";
  birch.height = {9, 16};
  SpeciesSettings fern;
  fern.name = "fern";
  fern.height = {0.4F, 0.8F};
  const std::vector<SpeciesSettings> species{birch, fern};
  ScatterSettings settings;
  settings.species = {{"birch", 3}, {"fern", 8}};
  settings.density = 0.05;
  const Heightfield ground = flat(std::sqrt(static_cast<double>(state.range(0)) / 0.05));
  std::size_t plants = 0;
  for (auto _ : state) {
    Progress progress;
    plants += scatter(ground, settings, species, {}, 1, progress).size();
  }
  state.counters["plants"] =
      benchmark::Counter(static_cast<double>(plants), benchmark::Counter::kIsRate);
}
BENCHMARK(scatter_birch_and_fern)
    ->Arg(100'000)
    ->Arg(1'000'000)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
}  // namespace wold
