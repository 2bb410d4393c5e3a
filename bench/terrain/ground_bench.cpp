// Queries of ground that the renderer and the scatter make by the million, and whole terrains.

#include <benchmark/benchmark.h>

#include "base/hash.hpp"
#include "terrain/blur.hpp"
#include "terrain/operators.hpp"
#include "terrain/steps.hpp"

namespace wold {
namespace {

Heightfield ground_of(const char* op, int resolution) {
  const OperatorList operators = terrain_operators();
  const std::vector<TerrainStep> steps{make_step(operators, op)};
  Progress progress;
  return evaluate({.resolution = resolution}, steps, operators, 1, {}, progress).field;
}

DVec2 random_place(const Heightfield& field, int k) {
  return field.origin + field.size() * DVec2(uniform_double(random_bits(1, k, 0)),
                                             uniform_double(random_bits(1, k, 1)));
}

void ground_at_random_places(benchmark::State& state) {
  const Heightfield field = ground_of("fbm", static_cast<int>(state.range(0)));
  std::vector<DVec2> places;
  for (int k = 0; k < 4096; ++k) places.push_back(random_place(field, k));
  for (auto _ : state)
    for (const DVec2& place : places) benchmark::DoNotOptimize(ground_at(field, place));
  state.SetItemsProcessed(state.iterations() * 4096);
}
BENCHMARK(ground_at_random_places)->Arg(257)->Arg(1025)->Arg(4097);

void height_at_random_places(benchmark::State& state) {
  const Heightfield field = ground_of("fbm", static_cast<int>(state.range(0)));
  std::vector<DVec2> places;
  for (int k = 0; k < 4096; ++k) places.push_back(random_place(field, k));
  for (auto _ : state)
    for (const DVec2& place : places) benchmark::DoNotOptimize(height_at(field, place));
  state.SetItemsProcessed(state.iterations() * 4096);
}
BENCHMARK(height_at_random_places)->Arg(1025);

void operator_with_defaults(benchmark::State& state, const char* op) {
  for (auto _ : state) benchmark::DoNotOptimize(ground_of(op, 1025));
  state.SetItemsProcessed(state.iterations() * 1025 * 1025);
}
BENCHMARK_CAPTURE(operator_with_defaults, ridged, "ridged")->UseRealTime();
BENCHMARK_CAPTURE(operator_with_defaults, diamond_square, "diamond_square")->UseRealTime();
BENCHMARK_CAPTURE(operator_with_defaults, warp, "warp")->UseRealTime();

void blur_by_samples(benchmark::State& state) {
  const Heightfield field = ground_of("fbm", 1025);
  Progress progress;
  for (auto _ : state)
    benchmark::DoNotOptimize(blurred(field.height, static_cast<double>(state.range(0)), progress));
  state.SetItemsProcessed(state.iterations() * 1025 * 1025);
}
BENCHMARK(blur_by_samples)->Arg(2)->Arg(20)->UseRealTime();

}  // namespace
}  // namespace wold
