// Noise and fractals over grids, on one thread, in points per second and cycles per point of the
// time-stamp counter, of the fastest run. Peer: FastNoise2 0.10 on the machine of the project's
// records, one thread; its own table gives 7.8 cycles per point for Perlin noise on AVX2. Its
// fractals do not turn their octaves, ours do.
//
// Floors on Zen 4 with 512-bit vectors (16 points; per core cycle one multiply-add, one addition,
// one permute, one load, half a store; the core ran at 1.43 cycles of the counter):
// - Gradient noise, 50 samples per feature: 7 loads, 4 permutes, 3 multiply-adds and a store: 7
// cycles
//   per vector, 0.3 of the counter per point. Measured 0.8; where the rest goes is not known.
// - One octave of a fractal: 23 multiply-adds and multiplications, 13 additions and roundings, 8
//   permutes that seem to share units with the first: 27 core cycles per vector, 1.2 of the counter
//   per point. Measured 36 core cycles for coarse octaves, 40 to 52 for the finest two; ridged
//   adds 6.

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <chrono>
#include <vector>

#if defined(__x86_64__)
#include <x86intrin.h>
#endif

#include "base/grid.hpp"
#include "base/parallel.hpp"
#include "noise/fractal.hpp"
#include "noise/noise.hpp"

namespace wold {
namespace {

std::uint64_t cycle_count() {
#if defined(__x86_64__)
  return __rdtsc();
#else
  return static_cast<std::uint64_t>(std::chrono::steady_clock::now().time_since_epoch().count());
#endif
}

// Cycles of the time-stamp counter per second, measured once over 50 ms.
double counter_frequency() {
  static const double frequency = [] {
    using Clock = std::chrono::steady_clock;
    const auto began = Clock::now();
    const std::uint64_t first = cycle_count();
    while (Clock::now() - began < std::chrono::milliseconds(50)) {
    }
    const std::uint64_t last = cycle_count();
    return static_cast<double>(last - first) /
           std::chrono::duration<double>(Clock::now() - began).count();
  }();
  return frequency;
}

/// Runs `work`, which makes `points` points, and reports the fastest run, which other programs
/// disturb least. `peer` is FastNoise2's rate in Mpoints/s, 0 for none.
template <class Work>
void measure(benchmark::State& state, double points, double peer, const Work& work,
             bool perlin = false) {
  const ThreadLimit one_thread(1);
  std::uint64_t best = ~std::uint64_t{0};
  for (auto _ : state) {
    const std::uint64_t began = cycle_count();
    work();
    best = std::min(best, cycle_count() - began);
  }
  const double cycles = static_cast<double>(best) / points;
  const double rate = counter_frequency() / cycles / 1e6;
  state.counters["cycles/point"] = cycles;
  state.counters["Mpoints/s"] = rate;
  state.counters["TSC_GHz"] = counter_frequency() / 1e9;
  if (peer > 0) {
    state.counters["x_FastNoise2"] = rate / peer;
    state.SetLabel(fmt::format("FastNoise2 0.10 figure: {} Mpoints/s{}", peer,
                               perlin ? ", 7.8 cycles/point on AVX2" : ""));
  }
}

constexpr int size = 512;  // short enough that a run is often undisturbed

// Samples per feature are the argument.
void noise_over_grid(benchmark::State& state, NoiseBasis basis, double peer) {
  Grid<float> grid(size, size);
  Progress progress;
  const double step = 1.0 / static_cast<double>(state.range(0));
  measure(
      state, 1.0 * size * size, peer,
      [&] {
        fill_noise(grid, basis, DVec2(0.1, 0.2), step, 1, progress);
        benchmark::DoNotOptimize(grid.values().data());
      },
      basis == NoiseBasis::gradient);
}

void gradient_noise_2d(benchmark::State& state) {
  noise_over_grid(state, NoiseBasis::gradient, 857);
}
void value_noise_2d(benchmark::State& state) {
  noise_over_grid(state, NoiseBasis::value, 1043);
}
BENCHMARK(gradient_noise_2d)->ArgName("samples_per_feature")->Arg(50)->Arg(4)->Arg(1);
BENCHMARK(value_noise_2d)->ArgName("samples_per_feature")->Arg(50)->Arg(4)->Arg(1);

// Eight octaves, the finest of which has four samples per feature, so that none fades.
void fractal_over_grid(benchmark::State& state, FractalKind kind, double peer) {
  Grid<float> grid(size, size);
  Progress progress;
  const Fractal f{.kind = kind, .octaves = 8};
  measure(state, 1.0 * size * size, peer, [&] {
    fill_fractal(grid, f, DVec2(0.1, 0.2), 1.0 / 512, 1, progress);
    benchmark::DoNotOptimize(grid.values().data());
  });
}

void fbm_8_octaves(benchmark::State& state) {
  fractal_over_grid(state, FractalKind::fbm, 170);
}
void ridged_8_octaves(benchmark::State& state) {
  fractal_over_grid(state, FractalKind::ridged, 174);
}
void hybrid_8_octaves(benchmark::State& state) {
  fractal_over_grid(state, FractalKind::hybrid, 0);
}
void turbulence_8_octaves(benchmark::State& state) {
  fractal_over_grid(state, FractalKind::turbulence, 0);
}
void eroded_8_octaves(benchmark::State& state) {
  fractal_over_grid(state, FractalKind::eroded, 0);
}
BENCHMARK(fbm_8_octaves);
BENCHMARK(ridged_8_octaves);
BENCHMARK(hybrid_8_octaves);
BENCHMARK(turbulence_8_octaves);
BENCHMARK(eroded_8_octaves);

// Single calls with value and derivative, as the renderer makes them.
template <class Position, class Noise>
void single_calls(benchmark::State& state, const Noise& noise) {
  constexpr int count = 4096;
  std::vector<Position> places;
  for (int i = 0; i < count; ++i) {
    Position p(0.37 * i);
    p.y = 0.61 * (i % 97);
    places.push_back(p);
  }
  measure(state, count, 0, [&] {
    float sum = 0;
    for (const Position& p : places) sum += noise(p);
    benchmark::DoNotOptimize(sum);
  });
}

void single_gradient_noise_2d(benchmark::State& state) {
  single_calls<DVec2>(state, [](DVec2 p) {
    const Sample2 s = gradient_noise(p, 1);
    return s.value + s.derivative.x;
  });
}
void single_value_noise_2d(benchmark::State& state) {
  single_calls<DVec2>(state, [](DVec2 p) {
    const Sample2 s = value_noise(p, 1);
    return s.value + s.derivative.x;
  });
}
void single_gradient_noise_3d(benchmark::State& state) {
  single_calls<DVec3>(state, [](DVec3 p) {
    const Sample3 s = gradient_noise(p, 1);
    return s.value + s.derivative.x;
  });
}
void single_value_noise_3d(benchmark::State& state) {
  single_calls<DVec3>(state, [](DVec3 p) {
    const Sample3 s = value_noise(p, 1);
    return s.value + s.derivative.x;
  });
}
void single_fbm_2d_8_octaves(benchmark::State& state) {
  const FractalSampler sampler({.octaves = 8}, 1);
  single_calls<DVec2>(state, [&](DVec2 p) { return sampler(p).value; });
}
BENCHMARK(single_gradient_noise_2d);
BENCHMARK(single_value_noise_2d);
BENCHMARK(single_gradient_noise_3d);
BENCHMARK(single_value_noise_3d);
BENCHMARK(single_fbm_2d_8_octaves);

}  // namespace
}  // namespace wold
