#pragma once
// What the tests of pipes, layers and dissolution share.

#include <map>
#include <string>

#include "../terrain/testing.hpp"
#include "base/parallel.hpp"

namespace wold::testing_water {

using namespace testing_terrain;

/// Runs an operator with maps by name.
template <class Work, class T>
TerrainResult run_with(Work work, const Heightfield& input, const T& parameters,
                       const std::map<std::string, Grid<float>>& maps = {}) {
  Progress progress;
  const std::map<std::string, TerrainResult> none;
  const TerrainContext context{1, {input.origin, input.size()}, {}, none, progress, &maps};
  return work(input, parameters, context);
}

inline double bumps(DVec2 x) {
  return 40 * std::sin(x.x / 70) * std::cos(x.y / 90) + 12 * std::sin(x.x / 23 + x.y / 31);
}

/// Hills with hollows, 500 m above the scene's zero.
inline Heightfield hills(int width, int height, double cell) {
  return field_of(width, height, cell, {0, 0}, [](DVec2 x) {
    return 500 + 0.1 * x.x + bumps(x) + 3 * std::sin(x.x / 7) * std::sin(x.y / 9);
  });
}

inline void expect_balanced(const TerrainResult& result) {
  ASSERT_EQ(result.balances.size(), 2U);
  for (const Balance& b : result.balances) {
    EXPECT_GT(b.moved, 0) << b.quantity;
    EXPECT_LE(std::abs(b.error()), 1e-6 * b.moved) << b.quantity;
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
    EXPECT_EQ(one.field.height, other.field.height);
    EXPECT_EQ(one.maps, other.maps);
  }
}

/// That work of T with these parameters, once begun, ends soon after it was cancelled.
template <class Work, class T>
void expect_cancels(Work work, const Heightfield& input, const T& parameters) {
  Progress progress;
  Progress* told = nullptr;
  Progress cancelling([&](const ProgressReport& report) {
    if (report.done > 0) told->cancel();
  });
  told = &cancelling;
  const std::map<std::string, TerrainResult> none;
  const TerrainContext context{1, {input.origin, input.size()}, {}, none, cancelling};
  EXPECT_NE(error_text([&] { work(input, parameters, context); }, ErrorKind::cancelled),
            "no error");
}

}  // namespace wold::testing_water
