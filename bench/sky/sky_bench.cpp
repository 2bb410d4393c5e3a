// Time of what the path tracer asks of the sky for every ray, and of building it.
#include "sky/sky.hpp"

#include <benchmark/benchmark.h>

#include "base/hash.hpp"

namespace wold {
namespace {

std::vector<Vec2> random_points() {
  std::vector<Vec2> points;
  for (int k = 0; k < 4096; ++k)
    points.emplace_back(uniform(random_bits(1, k, 0)), uniform(random_bits(1, k, 1)));
  return points;
}

void build(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(Sky());
}
BENCHMARK(build)->Unit(benchmark::kMillisecond)->UseRealTime();

void sample(benchmark::State& state) {
  const Sky sky;
  const std::vector<Vec2> points = random_points();
  std::size_t k = 0;
  for (auto _ : state) benchmark::DoNotOptimize(sky.sample_sky(points[++k % points.size()]));
}
BENCHMARK(sample);

void look_up(benchmark::State& state) {
  const Sky sky;
  std::vector<Vec3> directions;
  for (const Vec2 u : random_points()) directions.push_back(sky.sample_sky(u).direction);
  std::size_t k = 0;
  for (auto _ : state) {
    const Vec3 d = directions[++k % directions.size()];
    benchmark::DoNotOptimize(sky.radiance(d));
    benchmark::DoNotOptimize(sky.sky_pdf(d));
  }
}
BENCHMARK(look_up);

void through_haze(benchmark::State& state) {
  const Sky sky;
  std::vector<Vec3> directions;
  for (const Vec2 u : random_points()) directions.push_back(sky.sample_sky(u).direction);
  std::size_t k = 0;
  for (auto _ : state) {
    const Vec3 d = directions[++k % directions.size()];
    benchmark::DoNotOptimize(sky.through_haze(Vec3(500), Vec3(0, 0, 50), d, 800));
  }
}
BENCHMARK(through_haze);

}  // namespace
}  // namespace wold
