// Noise and fractals over grids: the same as the single calls, for any threads and tiles.
#include "noise/simd_targets.hpp"  // before Highway

#include <gtest/gtest.h>
#include <hwy/highway.h>

#include <array>
#include <cmath>
#include <cstdint>

#include "base/error.hpp"
#include "base/grid.hpp"
#include "base/parallel.hpp"
#include "noise/fractal.hpp"
#include "noise/noise.hpp"

namespace wold {
namespace {

constexpr std::array kinds{FractalKind::fbm, FractalKind::hybrid, FractalKind::ridged,
                           FractalKind::turbulence, FractalKind::eroded};
constexpr std::array bases{NoiseBasis::gradient, NoiseBasis::value};

Grid<float> noise_grid(int width, int height, NoiseBasis basis, DVec2 origin, double step) {
  Grid<float> grid(width, height, -9);
  Progress progress;
  fill_noise(grid, basis, origin, step, 5, progress);
  return grid;
}
Grid<float> fractal_grid(int width, int height, const Fractal& f, DVec2 origin, double step) {
  Grid<float> grid(width, height, -9);
  Progress progress;
  fill_fractal(grid, f, origin, step, 5, progress);
  return grid;
}

TEST(FillNoise, AgreesWithSingleCalls) {
  for (const NoiseBasis basis : bases)
    for (const double step : {0.0, 1 / 1024.0, 0.02, 0.25, 0.49, 0.94, 1.0, 3.7, -0.3})
      for (const DVec2 origin : {DVec2(-3.3, -1.7), DVec2(1e6 + 0.1, -1e6)}) {
        const Grid<float> grid = noise_grid(75, 21, basis, origin, step);
        for (int j = 0; j < grid.height(); ++j)
          for (int i = 0; i < grid.width(); ++i) {
            const DVec2 p = origin + step * DVec2(i, j);
            const Sample2 s =
                basis == NoiseBasis::gradient ? gradient_noise(p, 5) : value_noise(p, 5);
            ASSERT_NEAR(grid(i, j), s.value, 5e-6) << i << ' ' << j << " step " << step;
          }
      }
}

TEST(FillNoise, WidthsAreFilledToTheLastSampleAndNoFurther) {
  for (int width = 1; width < 40; ++width) {
    Grid<float> grid(width + 2, 5, -9);
    Progress progress;
    fill_noise(grid.view().sub(1, 1, width, 3), NoiseBasis::gradient, DVec2(0.3, 0.4), 0.1, 5,
               progress);
    for (int j = 0; j < 5; ++j)
      for (int i = 0; i < width + 2; ++i)
        EXPECT_EQ(grid(i, j) == -9, i == 0 || i > width || j == 0 || j == 4) << width;
  }
  Grid<float> empty;
  Progress progress;
  fill_noise(empty, NoiseBasis::gradient, DVec2(0), 1, 1, progress);
  fill_fractal(empty, {}, DVec2(0), 1, 1, progress);
}

TEST(FillFractal, AgreesWithSingleCalls) {
  for (const FractalKind kind : kinds)
    for (const NoiseBasis basis : bases)
      for (const double step : {1 / 512.0, 0.013, 0.22, -0.02}) {
        const Fractal f{.kind = kind, .basis = basis, .octaves = 8, .smooth_ridges = 0.01F};
        const DVec2 origin(-2.3, 4.1);
        const Grid<float> grid = fractal_grid(83, 37, f, origin, step);
        const FractalSampler sampler(f, 5);
        const FractalBounds range = bounds(f);
        for (int j = 0; j < grid.height(); ++j)
          for (int i = 0; i < grid.width(); ++i) {
            const float value =
                sampler(origin + step * DVec2(i, j), static_cast<float>(std::abs(step))).value;
            ASSERT_NEAR(grid(i, j), value, 1e-5 * (range.high - range.low))
                << static_cast<int>(kind) << static_cast<int>(basis) << ' ' << i << ' ' << j
                << " step " << step;
          }
      }
}

TEST(FillFractal, OctavesNearTheNyquistLimitAgreeToo) {
  for (const double step : {0.3, 0.43, 0.48, 0.499, 0.5, 2.0}) {
    const Fractal f{.octaves = 2, .lacunarity = 1.01F};
    const Grid<float> grid = fractal_grid(70, 70, f, DVec2(0.1, 0.2), step);
    for (int j = 0; j < 70; ++j)
      for (int i = 0; i < 70; ++i)
        ASSERT_NEAR(
            grid(i, j),
            fractal(f, DVec2(0.1, 0.2) + step * DVec2(i, j), 5, static_cast<float>(step)).value,
            1e-5)
            << step;
  }
}

TEST(Fill, IsTheSameForAnyNumberOfThreads) {
  const auto both = [] {
    Grid<float> grid = noise_grid(700, 150, NoiseBasis::gradient, DVec2(0.1, 0.2), 0.03);
    const Grid<float> more =
        fractal_grid(700, 150, {.kind = FractalKind::ridged}, DVec2(7, 8), 0.03);
    for (int j = 0; j < grid.height(); ++j)
      for (int i = 0; i < grid.width(); ++i) grid(i, j) += 3 * more(i, j);
    return grid;
  };
  const Grid<float> one = [&] {
    const ThreadLimit limit(1);
    return both();
  }();
  for (const int threads : {2, 4}) {
    const ThreadLimit limit(threads);
    EXPECT_EQ(both(), one) << threads;
  }
}

TEST(Fill, PartOfAGridEqualsTheWholeThere) {
  // The step and origin are sums of few powers of two: the places of the samples are exact.
  constexpr double step = 0.0625;
  const DVec2 origin(-10.5, 3.25);
  for (const NoiseBasis basis : bases) {
    const Fractal f{.kind = FractalKind::ridged, .basis = basis, .octaves = 5};
    const Grid<float> whole = noise_grid(600, 200, basis, origin, step);
    const Grid<float> whole_fractal = fractal_grid(600, 200, f, origin, step);
    for (const IVec2 corner : {IVec2(0, 0), IVec2(1, 3), IVec2(517, 70), IVec2(66, 34)}) {
      const DVec2 place = origin + step * DVec2(corner);
      const Grid<float> part = noise_grid(37, 29, basis, place, step);
      const Grid<float> part_fractal = fractal_grid(37, 29, f, place, step);
      for (int j = 0; j < 29; ++j)
        for (int i = 0; i < 37; ++i) {
          ASSERT_EQ(part(i, j), whole(corner.x + i, corner.y + j)) << i << ' ' << j;
          ASSERT_EQ(part_fractal(i, j), whole_fractal(corner.x + i, corner.y + j)) << i << ' ' << j;
        }
    }
  }
}

/// Runs what Highway dispatches on one instruction set while it lives.
class OneTarget {
 public:
  explicit OneTarget(std::int64_t target) { choose(target); }
  OneTarget(const OneTarget&) = delete;
  OneTarget& operator=(const OneTarget&) = delete;
  ~OneTarget() { choose(0); }

 private:
  static void choose(std::int64_t target) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  }
};

TEST(Fill, InstructionSetsAgree) {
  const std::int64_t supported = hwy::SupportedTargets() & HWY_TARGETS;
  for (const NoiseBasis basis : bases)
    for (const FractalKind kind : kinds)
      for (const double step : {1 / 512.0, 0.02, 0.24, 0.3}) {
        const Fractal f{.kind = kind, .basis = basis};
        const Grid<float> best = fractal_grid(140, 70, f, DVec2(0.7, -20.3), step);
        const Grid<float> best_noise = noise_grid(140, 70, basis, DVec2(0.7, -20.3), step);
        for (std::int64_t target = 1; target > 0 && target <= supported; target <<= 1) {
          if ((supported & target) == 0) continue;
          const OneTarget only(target);
          const Grid<float> grid = fractal_grid(140, 70, f, DVec2(0.7, -20.3), step);
          const Grid<float> noise = noise_grid(140, 70, basis, DVec2(0.7, -20.3), step);
          for (int j = 0; j < 70; ++j)
            for (int i = 0; i < 140; ++i) {
              ASSERT_NEAR(grid(i, j), best(i, j), 2e-5) << hwy::TargetName(target);
              ASSERT_NEAR(noise(i, j), best_noise(i, j), 2e-6) << hwy::TargetName(target);
            }
        }
      }
}

TEST(Fill, CanBeCancelled) {
  Progress progress;
  progress.cancel();
  Grid<float> grid(64, 64);
  EXPECT_THROW(fill_noise(grid, NoiseBasis::value, DVec2(0), 0.1, 1, progress), Error);
  EXPECT_THROW(fill_fractal(grid, {}, DVec2(0), 0.1, 1, progress), Error);
}

}  // namespace
}  // namespace wold
