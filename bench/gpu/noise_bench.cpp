// Fractals in a fragment shader (noise/*.glsl), in points per second of the fastest run, beside the
// C++ of the same run on all threads: in the plane the vectorised fill, in space single calls. On a
// driver that draws by the processor the ratio says what a shader costs there.

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <string>

#include "base/grid.hpp"
#include "base/parallel.hpp"
#include "gpu/context.hpp"
#include "gpu/objects.hpp"
#include "noise/fractal.hpp"
#include "shaders/assembly.hpp"

namespace wold {
namespace {

constexpr int size = 512;
constexpr double points = 1.0 * size * size;

/// Milliseconds of one run, and after a first.
double fastest(int runs, const std::function<double()>& run) {
  double best = run();
  for (int k = 0; k < runs; ++k) best = std::min(best, run());
  return best;
}

double milliseconds(const std::function<void()>& work) {
  const auto began = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - began)
      .count();
}

/// `expression` of p, the place of a pixel in lattice units, and of `octaves`, which the compiler
/// does not know.
double shader_time(const std::string& expression, int octaves) {
  const std::string body =
      "#include \"noise/fractal.glsl\"\n"
      "uniform int octaves;\n"
      "out float result;\n"
      "void main() {\n"
      "  vec3 p = vec3(gl_FragCoord.xy / 512.0 + vec2(0.1, 0.2), 0.3);\n"
      "  result = " +
      expression + ";\n}\n";
  const ShaderDialect dialect = gpu_info().dialect;
  const GpuProgram program(assemble_shader("gpu/full_screen.vert.glsl", dialect),
                           assemble_shader_text("noise_bench", body, dialect));
  const GpuTarget target(size, size, std::array{PixelFormat::r32f}, false);
  target.bind();
  program.use();
  program.set("octaves", octaves);
  return fastest(8, [] {
    GpuTimer timer;
    timer.begin();
    draw_full_screen();
    return timer.end();
  });
}

void report(benchmark::State& state, double shader, double twin) {
  state.counters["Mpoints/s"] = points / shader / 1e3;
  state.counters["Mpoints/s_C++"] = points / twin / 1e3;
  state.counters["x_C++"] = twin / shader;
  state.SetLabel(gpu_info().renderer);
}

void plane(benchmark::State& state, const std::string& name, const Fractal& f) {
  const OffscreenContext context;
  const std::string call = fmt::format(
      "{}(p.xy, Fractal({}, {}, 10, 2.0, 1.0, 1.0, 2.0, 0.0, 1.0), 1u, octaves, 0.0){}", name,
      static_cast<int>(f.kind), static_cast<int>(f.basis), name.ends_with("value") ? "" : ".y");
  Grid<float> grid(size, size);
  Progress progress;
  for (auto _ : state) {
    const double shader = shader_time(call, f.octaves);
    const double twin = fastest(8, [&] {
      return milliseconds([&] { fill_fractal(grid, f, DVec2(0.1, 0.2), 1.0 / size, 1, progress); });
    });
    report(state, shader, twin);
  }
}

void space(benchmark::State& state, const Fractal& f) {
  const OffscreenContext context;
  const FractalSampler sampler(f, 1);
  Grid<float> grid(size, size);
  for (auto _ : state) {
    const double shader =
        shader_time("fbm_value(p, Fractal(0, 1, 6, 2.0, 1.0, 1.0, 2.0, 0.0, 1.0), 1u, 6, 0.0)", 6);
    const double twin = fastest(3, [&] {
      return milliseconds([&] {
        parallel_for(0, size, [&](int j) {
          for (int i = 0; i < size; ++i)
            grid(i, j) = sampler(DVec3(i / 512.0 + 0.1, j / 512.0 + 0.2, 0.3)).value;
        });
      });
    });
    report(state, shader, twin);
  }
}

void march_ridged(benchmark::State& state) {
  plane(state, "ridged_value",
        {.kind = FractalKind::ridged, .octaves = static_cast<int>(state.range(0))});
}
void march_fbm(benchmark::State& state) {
  plane(state, "fbm_value", {.octaves = static_cast<int>(state.range(0))});
}
void normal_ridged(benchmark::State& state) {
  plane(state, "ridged",
        {.kind = FractalKind::ridged, .octaves = static_cast<int>(state.range(0))});
}
void cloud_fbm(benchmark::State& state) {
  space(state, {.basis = NoiseBasis::value, .octaves = 6});
}
BENCHMARK(march_ridged)->ArgName("octaves")->Arg(4)->Arg(8)->Iterations(1);
BENCHMARK(march_fbm)->ArgName("octaves")->Arg(8)->Iterations(1);
BENCHMARK(normal_ridged)->ArgName("octaves")->Arg(8)->Iterations(1);
BENCHMARK(cloud_fbm)->Iterations(1);

}  // namespace
}  // namespace wold
