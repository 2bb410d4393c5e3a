#include "base/progress.hpp"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

#include "base/error.hpp"
#include "base/parallel.hpp"

namespace wold {
namespace {

/// Everything that a sink was told.
struct Record {
  std::vector<ProgressReport> reports;
  Progress progress{[this](const ProgressReport& r) { reports.push_back(r); }};
};

ErrorKind kind_of_check(const Progress& progress) {
  try {
    progress.check();
  } catch (const Error& error) {
    return error.kind();
  }
  return ErrorKind::internal;
}

TEST(Progress, ReportsBeginAndEndOfAStage) {
  Record record;
  record.progress.begin("droplets", 8, "rows");
  record.progress.advance(8);
  record.progress.end();
  ASSERT_EQ(record.reports.size(), 2U);
  EXPECT_EQ(record.reports[0].stage, "droplets");
  EXPECT_EQ(record.reports[0].done, 0);
  EXPECT_FALSE(record.reports[0].finished);
  EXPECT_EQ(record.reports[1].done, 8);
  EXPECT_EQ(record.reports[1].total, 8);
  EXPECT_EQ(record.reports[1].unit, "rows");
  EXPECT_TRUE(record.reports[1].finished);
}

TEST(Progress, BeginEndsTheStageBefore) {
  Record record;
  record.progress.begin("one", 1, "");
  record.progress.begin("two", 1, "");
  ASSERT_EQ(record.reports.size(), 3U);
  EXPECT_EQ(record.reports[1].stage, "one");
  EXPECT_TRUE(record.reports[1].finished);
  EXPECT_EQ(record.reports[2].stage, "two");
  record.progress.end();
  record.progress.end();
  EXPECT_EQ(record.reports.size(), 4U);
}

TEST(Progress, IsToldNoOftenerThanTheInterval) {
  Record record;
  record.progress.begin("samples", 1e6, "samples");
  const auto start = std::chrono::steady_clock::now();
  for (int k = 0; k < 200000; ++k) record.progress.advance();
  std::this_thread::sleep_for(2 * Progress::report_interval);
  record.progress.advance();
  const auto intervals = (std::chrono::steady_clock::now() - start) / Progress::report_interval + 2;
  EXPECT_GE(record.reports.size(), 2U);
  EXPECT_LE(record.reports.size(), static_cast<std::size_t>(intervals));
}

TEST(Progress, CountsFromAllThreads) {
  Record record;
  record.progress.begin("rows", 5000, "rows");
  parallel_for(0, 5000, [&](int) { record.progress.advance(); });
  record.progress.end();
  EXPECT_EQ(record.reports.back().done, 5000);
}

TEST(Progress, CancelStopsTheWork) {
  Progress progress;
  EXPECT_NO_THROW(progress.check());
  progress.cancel();
  EXPECT_TRUE(progress.cancelled());
  EXPECT_EQ(kind_of_check(progress), ErrorKind::cancelled);
  EXPECT_THROW(progress.advance(), Error);
  EXPECT_THROW(progress.begin("more", 1, ""), Error);
}

TEST(Progress, AFlagCancelsToo) {
  std::atomic<bool> flag = false;
  Progress progress({}, &flag);
  EXPECT_NO_THROW(progress.advance());
  flag = true;
  EXPECT_EQ(kind_of_check(progress), ErrorKind::cancelled);
}

TEST(Progress, CancelEndsAParallelLoop) {
  Progress progress;
  std::atomic<int> calls = 0;
  const auto body = [&](int) {
    if (++calls == 10) progress.cancel();
    progress.advance();
  };
  EXPECT_THROW(parallel_for(0, 1000000, body), Error);
  EXPECT_LT(calls.load(), 1000);
}

}  // namespace
}  // namespace wold
