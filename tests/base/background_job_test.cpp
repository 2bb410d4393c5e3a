#include "base/background_job.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <memory>

namespace wold {
namespace {

template <class T>
typename BackgroundJob<T>::Outcome outcome_of(BackgroundJob<T>& job) {
  for (;;) {
    if (auto outcome = job.take()) return std::move(*outcome);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

TEST(BackgroundJob, GivesItsResultOnce) {
  BackgroundJob<std::unique_ptr<int>> job;
  EXPECT_FALSE(job.busy());
  EXPECT_FALSE(job.take());
  job.begin([](Progress&) { return std::make_unique<int>(7); });
  EXPECT_TRUE(job.busy());
  EXPECT_EQ(*std::get<0>(outcome_of(job)), 7);
  EXPECT_FALSE(job.busy());
  EXPECT_FALSE(job.take());
}

TEST(BackgroundJob, ErrorsArriveAsErrors) {
  BackgroundJob<int> job;
  job.begin([](Progress&) -> int { throw Error(ErrorKind::input, "wrong"); });
  EXPECT_EQ(std::get<Error>(outcome_of(job)).message(), "wrong");
  job.begin([](Progress&) -> int { throw std::runtime_error("other"); });
  EXPECT_EQ(std::get<Error>(outcome_of(job)).kind(), ErrorKind::internal);
  job.begin([](Progress&) -> int { throw Error(ErrorKind::limit, "large"); });
  EXPECT_THROW(job.wait(), Error);
}

TEST(BackgroundJob, CanBeCancelledAndBegunAnew) {
  BackgroundJob<int> job;
  std::atomic<bool> ended = false;
  const auto endless = [&ended](Progress& progress) -> int {
    try {
      progress.begin("waiting", 0, "rounds");
      for (;;) {
        progress.advance();
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
    } catch (...) {
      ended = true;
      throw;
    }
  };
  job.begin(endless);
  job.cancel();
  EXPECT_EQ(std::get<Error>(outcome_of(job)).kind(), ErrorKind::cancelled);
  ended = false;
  job.begin(endless);
  job.begin([](Progress&) { return 3; });
  EXPECT_TRUE(ended);
  EXPECT_EQ(job.wait(), 3);
}

TEST(BackgroundJob, ItsEndWaitsForTheWork) {
  std::atomic<bool> ended = false;
  {
    BackgroundJob<int> job;
    job.begin([&](Progress& progress) {
      try {
        progress.begin("waiting", 0, "rounds");
        for (;;) progress.advance();
      } catch (const Error&) {
        ended = true;
      }
      return 0;
    });
  }
  EXPECT_TRUE(ended);
}

TEST(BackgroundJob, TellsHowFarItIs) {
  BackgroundJob<int> job;
  std::atomic<bool> go = false;
  job.begin([&](Progress& progress) {
    progress.begin("growing", 10, "trees");
    progress.advance(4);
    while (!go) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return 1;
  });
  while (job.report().stage.empty()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  EXPECT_EQ(job.report().stage, "growing");
  go = true;
  EXPECT_EQ(job.wait(), 1);
}

}  // namespace
}  // namespace wold
