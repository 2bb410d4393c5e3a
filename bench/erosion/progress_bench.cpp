// How long an operator is silent, and how long it goes on once cancelled: of ground of 2048 x 2048
// samples, or as many as the benchmark's argument says, 4 m apart. Promised are 10 reports per
// second and 100 ms. Other work on the machine counts in both. What takes longer is cut off after
// some seconds.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>

#include "base/error.hpp"
#include "base/hash.hpp"
#include "erosion/operators.hpp"
#include "terrain/operators.hpp"
#include "terrain/steps.hpp"

namespace wold {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int cancels = 4;
constexpr double cell = 4;           // m
constexpr double longest_run = 8e3;  // ms

double milliseconds(Clock::duration time) {
  return std::chrono::duration<double, std::milli>(time).count();
}

const Heightfield& mountains(int resolution) {
  static Heightfield field;
  if (field.height.width() == resolution) return field;
  const OperatorList operators = terrain_operators();
  const std::vector<TerrainStep> steps{make_step(operators, "ridged")};
  Progress progress;
  const TerrainSettings settings{.size = cell * (resolution - 1), .resolution = resolution};
  field = evaluate(settings, steps, operators, 1, {}, progress).field;
  return field;
}

/// False if it was cancelled.
bool runs_through(const TerrainOperator& op, const Heightfield& field, Progress& progress) {
  const std::map<std::string, TerrainResult> none;
  const TerrainContext context{1, {field.origin, field.size()}, {}, none, progress};
  try {
    const ProgressStage step(progress, "step", 0, "");
    op.run(field, op.defaults, context);
  } catch (const Error&) {
    return false;
  }
  return true;
}

/// The longest time between two reports, ms, and what had been done before it.
struct Silence {
  double longest = 0;
  std::string after;
};

Silence silence_of(const TerrainOperator& op, const Heightfield& field, double& whole) {
  Silence out;
  const Clock::time_point began = Clock::now();
  Clock::time_point last = began;
  std::string before = "the start";
  const auto note = [&](const std::string& what) {
    const Clock::time_point now = Clock::now();
    if (milliseconds(now - last) > out.longest) out = {milliseconds(now - last), before};
    last = now;
    before = what;
  };
  std::atomic<bool> cut = false;
  Progress progress(
      [&](const ProgressReport& report) {
        if (milliseconds(Clock::now() - began) > longest_run) cut = true;
        note(report.stage + " " + std::to_string(static_cast<long long>(report.done)) + " " +
             report.unit);
      },
      &cut);
  runs_through(op, field, progress);
  if (!cut) note("");
  whole = milliseconds(Clock::now() - began);
  return out;
}

/// The time from a cancel to the end, ms; 0 if it came too late.
double answer_to(const TerrainOperator& op, const Heightfield& field, double after) {
  Progress progress;
  Clock::time_point cancelled;
  std::thread canceller([&] {
    std::this_thread::sleep_for(std::chrono::duration<double, std::milli>(after));
    cancelled = Clock::now();
    progress.cancel();
  });
  const bool through = runs_through(op, field, progress);
  const Clock::time_point ended = Clock::now();
  canceller.join();
  return through ? 0 : milliseconds(ended - cancelled);
}

void reports_and_cancel(benchmark::State& state, const TerrainOperator& op) {
  const Heightfield& field = mountains(static_cast<int>(state.range(0)));
  Silence silence;
  double slowest = 0;
  double slowest_at = 0;
  for (auto _ : state) {
    double whole = 0;
    silence = silence_of(op, field, whole);
    for (int k = 0; k < cancels; ++k) {
      const double after = whole * static_cast<double>(uniform(random_bits(7, k, 0)));
      const double answer = answer_to(op, field, after);
      if (answer > slowest) slowest_at = after;
      slowest = std::max(slowest, answer);
    }
    state.counters["whole_ms"] = whole;
  }
  state.counters["silent_ms"] = silence.longest;
  state.counters["cancel_ms"] = slowest;
  state.counters["cancel_at_ms"] = slowest_at;
  state.SetLabel("silent after " + silence.after);
}

const bool registered = [] {
  for (const TerrainOperator& op : erosion_operators())
    benchmark::RegisterBenchmark(("progress/" + op.name()).c_str(), reports_and_cancel, op)
        ->Arg(2048)
        ->Iterations(1)
        ->UseRealTime()
        ->Unit(benchmark::kMillisecond);
  return true;
}();

}  // namespace
}  // namespace wold
