#pragma once
// Parallel loops (oneTBB) whose results do not depend on the number of threads.

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace wold {

/// Holds the number of worker threads at `threads` while it lives; 0 leaves it to the machine.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads)
      : control_(tbb::global_control::max_allowed_parallelism,
                 threads > 0 ? static_cast<std::size_t>(threads) : default_threads()) {}

 private:
  static std::size_t default_threads() {
    return tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  }
  tbb::global_control control_;
};

/// Calls `body(i)` for every i in [begin, end), in any order, on any thread. `grain` is the least
/// number of calls worth a task. An exception from a body ends the loop and is rethrown here.
template <class Body>
void parallel_for(int begin, int end, const Body& body, int grain = 1) {
  if (begin >= end) return;
  tbb::parallel_for(tbb::blocked_range<int>(begin, end, static_cast<std::size_t>(grain)),
                    [&](const tbb::blocked_range<int>& range) {
                      for (int i = range.begin(); i != range.end(); ++i) body(i);
                    });
}

/// Reduces `map(i)`, i in [begin, end), with `combine`, in an order fixed by `chunk` alone: the
/// same bits for any number of threads. `identity` is the value of an empty range.
template <class T, class Map, class Combine>
T parallel_reduce(int begin, int end, T identity, const Map& map, const Combine& combine,
                  int chunk = 64) {
  const int count = std::max(0, (end - begin + chunk - 1) / chunk);
  std::vector<T> partial(static_cast<std::size_t>(count), identity);
  parallel_for(0, count, [&](int c) {
    const int first = begin + c * chunk;
    const int last = std::min(end, first + chunk);
    T sum = identity;
    for (int i = first; i < last; ++i) sum = combine(sum, map(i));
    partial[static_cast<std::size_t>(c)] = sum;
  });
  T total = identity;
  for (const T& sum : partial) total = combine(total, sum);
  return total;
}

}  // namespace wold
