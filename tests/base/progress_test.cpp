#include "base/progress.hpp"

#include <gtest/gtest.h>

#include <string>
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

TEST(Progress, AStageWithinAnotherGivesItBack) {
  Record record;
  record.progress.begin("layers", 10, "rows");
  record.progress.advance(3);
  {
    const ProgressStage inner(record.progress, "noise", 100, "samples");
    record.progress.advance(50);
  }
  record.progress.advance(4);
  record.progress.end();
  ASSERT_EQ(record.reports.size(), 4U);
  EXPECT_EQ(record.reports[1].stage, "noise");
  EXPECT_EQ(record.reports[1].done, 0);
  EXPECT_TRUE(record.reports[1].inner);
  EXPECT_EQ(record.reports[2].stage, "noise");
  EXPECT_EQ(record.reports[2].done, 50);
  EXPECT_TRUE(record.reports[2].finished);
  const ProgressReport& outer = record.reports[3];
  EXPECT_EQ(outer.stage, "layers");
  EXPECT_EQ(outer.unit, "rows");
  EXPECT_EQ(outer.done, 7);
  EXPECT_EQ(outer.total, 10);
  EXPECT_TRUE(outer.finished);
  EXPECT_FALSE(outer.inner);
  EXPECT_GE(outer.seconds, record.reports[2].seconds);
}

TEST(Progress, AStageBegunWithinAStageOfABlockDoesNotEndIt) {
  Record record;
  {
    const ProgressStage step(record.progress, "step", 0, "");
    record.progress.begin("one", 1, "");
    record.progress.begin("two", 1, "");
    record.progress.end();
    record.progress.end();  // not the block's
    record.progress.begin("left open", 1, "");
  }
  std::vector<std::string> finished;
  for (const ProgressReport& r : record.reports)
    if (r.finished) finished.push_back(r.stage);
  EXPECT_EQ(finished, (std::vector<std::string>{"one", "two", "left open", "step"}));
}

TEST(Progress, NothingIsToldOutsideOfStages) {
  Record record;
  { const ProgressStage stage(record.progress, "stage", 1, ""); }
  std::this_thread::sleep_for(2 * Progress::report_interval);
  record.progress.advance();
  record.progress.end();
  ASSERT_EQ(record.reports.size(), 2U);
  for (const ProgressReport& r : record.reports) EXPECT_EQ(r.stage, "stage");
}

TEST(Progress, AnExceptionGivesTheOuterStageBack) {
  Record record;
  record.progress.begin("outer", 8, "rows");
  record.progress.advance(2);
  const auto work = [&] {
    const ProgressStage inner(record.progress, "inner", 5, "");
    record.progress.begin("innermost", 5, "");
    record.progress.advance(5);
    throw Error(ErrorKind::input, "no");
  };
  EXPECT_THROW(work(), Error);
  record.progress.advance(3);
  record.progress.end();
  EXPECT_EQ(record.reports.size(), 4U) << "what failed has not finished";
  EXPECT_EQ(record.reports.back().stage, "outer");
  EXPECT_EQ(record.reports.back().done, 5);
  EXPECT_EQ(record.reports.back().total, 8);
}

TEST(Progress, NoStageBeginsOnceCancelled) {
  Record record;
  record.progress.begin("outer", 8, "rows");
  record.progress.cancel();
  EXPECT_THROW(ProgressStage(record.progress, "inner", 1, ""), Error);
  record.progress.end();
  EXPECT_EQ(record.reports.back().stage, "outer");
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
