#pragma once
// Progress of long work, and its cancellation.
//
// Work takes a `Progress&`, opens a stage, and says how far it is; any thread may. Whoever started
// the work gives a sink that is told at most every `report_interval`, and may cancel: the work
// then throws `Error` of kind `cancelled` at its next `check` or `advance` and leaves its input
// as it was.

#include <atomic>
#include <chrono>
#include <functional>
#include <mutex>
#include <string>

namespace wold {

struct ProgressReport {
  std::string stage;      ///< "rendering", "droplets"
  std::string unit;       ///< what `done` counts: "samples", "rows"
  double done = 0;        ///< in units
  double total = 0;       ///< in units; 0 when unknown
  double seconds = 0;     ///< since the stage began
  bool finished = false;  ///< the last report of its stage
};

class Progress {
 public:
  using Sink = std::function<void(const ProgressReport&)>;
  static constexpr std::chrono::milliseconds report_interval{50};

  /// Silent; can be cancelled only by `cancel`.
  Progress() = default;
  /// `cancel_flag`, if given, cancels as well when it turns true (a signal handler may set it); it
  /// must outlive this object.
  explicit Progress(Sink sink, const std::atomic<bool>* cancel_flag = nullptr)
      : sink_(std::move(sink)), cancel_flag_(cancel_flag) {}

  /// Ends the stage before and begins one. Called by one thread.
  void begin(std::string stage, double total, std::string unit);
  /// Adds to what is done. Throws `Error(cancelled)` once cancelled. Any thread.
  void advance(double amount = 1);
  /// Throws `Error(cancelled)` once cancelled. Any thread; cheap enough for every row.
  void check() const;
  /// Sends the last report of the stage. Called by one thread.
  void end();

  void cancel() { cancelled_.store(true, std::memory_order_relaxed); }
  bool cancelled() const {
    return cancelled_.load(std::memory_order_relaxed) ||
           (cancel_flag_ != nullptr && cancel_flag_->load(std::memory_order_relaxed));
  }

 private:
  using Clock = std::chrono::steady_clock;

  ProgressReport report(bool finished) const;

  Sink sink_;
  const std::atomic<bool>* cancel_flag_ = nullptr;
  std::atomic<bool> cancelled_ = false;
  std::atomic<double> done_ = 0;
  std::mutex mutex_;  // guards what follows and calls of the sink
  std::string stage_;
  std::string unit_;
  double total_ = 0;
  Clock::time_point began_;
  std::atomic<Clock::time_point> last_report_{};
};

}  // namespace wold
