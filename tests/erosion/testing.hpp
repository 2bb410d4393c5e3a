#pragma once
// What the tests of erosion share.

#include <cmath>
#include <initializer_list>
#include <map>
#include <string>

#include "../terrain/testing.hpp"
#include "base/parallel.hpp"

namespace wold::testing_erosion {

using namespace testing_terrain;

/// Runs an operator with maps by name.
template <class Work, class T>
TerrainResult run_with(Work work, const Heightfield& input, const T& parameters,
                       const std::map<std::string, Grid<float>>& maps = {},
                       const std::filesystem::path& folder = {}) {
  Progress progress;
  const std::map<std::string, TerrainResult> none;
  const TerrainContext context{1, {input.origin, input.size()}, folder, none, progress, &maps};
  return work(input, parameters, context);
}

inline Heightfield mountains(int resolution, double size = 2000) {
  Steps steps;
  steps.add("ridged", {});
  return steps.evaluate({.size = size, .resolution = resolution}).field;
}

/// That these quantities were moved, and none was lost.
inline void expect_balanced(const TerrainResult& result,
                            std::initializer_list<const char*> quantities) {
  ASSERT_EQ(result.balances.size(), quantities.size());
  auto balance = result.balances.begin();
  for (const char* quantity : quantities) {
    EXPECT_EQ(balance->quantity, quantity);
    EXPECT_GT(balance->moved, 0) << quantity;
    EXPECT_LE(std::abs(balance->error()), 1e-6 * balance->moved) << quantity;
    ++balance;
  }
}

template <class Run>
void expect_same_for_any_threads(const Run& run_once) {
  const auto with_threads = [&](int threads) {
    const ThreadLimit limit(threads);
    return run_once();
  };
  const TerrainResult one = with_threads(1);
  for (const int threads : {1, 2, 4}) {
    const TerrainResult other = with_threads(threads);
    EXPECT_EQ(one.field.height, other.field.height) << threads;
    EXPECT_EQ(one.maps, other.maps) << threads;
  }
}

/// Root of the mean squared difference of heights, where `fine` has two cells for one of `coarse`.
inline double rms_difference(const Grid<float>& coarse, const Grid<float>& fine) {
  EXPECT_EQ(fine.width(), 2 * coarse.width() - 1);
  EXPECT_EQ(fine.height(), 2 * coarse.height() - 1);
  double sum = 0;
  for (int j = 0; j < coarse.height(); ++j)
    for (int i = 0; i < coarse.width(); ++i)
      sum += std::pow(static_cast<double>(coarse(i, j)) - fine(2 * i, 2 * j), 2);
  return std::sqrt(sum / static_cast<double>(coarse.size()));
}

/// That work which was cancelled before does not begin.
template <class Work, class T>
void expect_stays_cancelled(Work work, const Heightfield& input, const T& parameters) {
  Progress progress;
  progress.cancel();
  const std::map<std::string, TerrainResult> none;
  const TerrainContext context{1, {input.origin, input.size()}, {}, none, progress};
  error_text([&] { work(input, parameters, context); }, ErrorKind::cancelled);
}

/// That work of T with these parameters, once begun, ends soon after it was cancelled.
template <class Work, class T>
void expect_cancels(Work work, const Heightfield& input, const T& parameters) {
  Progress* told = nullptr;
  Progress progress([&](const ProgressReport& report) {
    if (report.done > 0) told->cancel();
  });
  told = &progress;
  const std::map<std::string, TerrainResult> none;
  const TerrainContext context{1, {input.origin, input.size()}, {}, none, progress};
  error_text([&] { work(input, parameters, context); }, ErrorKind::cancelled);
}

}  // namespace wold::testing_erosion
