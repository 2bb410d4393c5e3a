#include "base/parallel.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <numeric>
#include <thread>
#include <vector>

#include "base/error.hpp"

namespace wold {
namespace {

TEST(Parallel, CallsEachIndexOnce) {
  for (const int threads : {1, 2, 4}) {
    const ThreadLimit limit(threads);
    std::vector<std::atomic<int>> calls(1000);
    parallel_for(
        0, 1000, [&](int i) { ++calls[static_cast<std::size_t>(i)]; }, 7);
    for (const auto& n : calls) EXPECT_EQ(n.load(), 1);
  }
}

TEST(Parallel, EmptyAndReversedRangesCallNothing) {
  int calls = 0;
  parallel_for(5, 5, [&](int) { ++calls; });
  parallel_for(5, 2, [&](int) { ++calls; });
  EXPECT_EQ(calls, 0);
  EXPECT_EQ(parallel_reduce(
                3, 3, 17, [](int i) { return i; }, std::plus<>()),
            17);
}

/// Floats whose sum depends on the order of adding.
float uneven(int i) {
  return std::sin(static_cast<float>(i)) * std::exp2(static_cast<float>(i % 20));
}

TEST(Parallel, ReducesToTheSameBitsForAnyNumberOfThreads) {
  std::vector<float> sums;
  for (const int threads : {1, 2, 4})
    for (int repeat = 0; repeat < 5; ++repeat) {
      const ThreadLimit limit(threads);
      sums.push_back(parallel_reduce(0, 100003, 0.0F, uneven, std::plus<>()));
    }
  for (const float sum : sums) EXPECT_EQ(sum, sums.front());
}

TEST(Parallel, ReduceFindsWhatALoopFinds) {
  EXPECT_EQ(parallel_reduce(
                -10, 1001, 0L, [](int i) { return long{i}; }, std::plus<>(), 13),
            500500L - 55L);
  const auto larger = [](int a, int b) { return std::max(a, b); };
  EXPECT_EQ(parallel_reduce(
                0, 5000, -1, [](int i) { return i * 37 % 5000; }, larger),
            4999);
}

TEST(Parallel, AnExceptionComesOut) {
  const auto body = [](int i) {
    if (i == 613) throw Error(ErrorKind::limit, "too much");
  };
  EXPECT_THROW(parallel_for(0, 1000, body), Error);
}

TEST(Parallel, ThreadLimitHoldsThreads) {
  const ThreadLimit limit(1);
  const auto self = std::this_thread::get_id();
  std::atomic<int> elsewhere = 0;
  parallel_for(0, 200, [&](int) {
    if (std::this_thread::get_id() != self) ++elsewhere;
  });
  EXPECT_EQ(elsewhere.load(), 0);
}

}  // namespace
}  // namespace wold
