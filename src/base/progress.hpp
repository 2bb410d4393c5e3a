#pragma once
// Progress of long work, and its cancellation.
//
// Work takes a `Progress&`, opens a stage, and says how far it is; any thread may. Work that may be
// called within a stage of others opens its own as a `ProgressStage`: the outer one goes on after
// it. Whoever started the work gives a sink that is told at most every `report_interval`, and may
// cancel: the work then throws `Error` of kind `cancelled` at its next `check` or `advance` and
// leaves its input as it was.

#include <atomic>
#include <chrono>
#include <functional>
#include <mutex>
#include <string>
#include <vector>

namespace wold {

struct ProgressReport {
  std::string stage;      ///< "rendering", "droplets"
  std::string unit;       ///< what `done` counts: "samples", "rows"
  double done = 0;        ///< in units
  double total = 0;       ///< in units; 0 when unknown
  double seconds = 0;     ///< since the stage began
  bool finished = false;  ///< the last report of its stage
  bool inner = false;     ///< within another stage, which goes on after it
};

class Progress {
 public:
  /// Must not throw.
  using Sink = std::function<void(const ProgressReport&)>;
  static constexpr std::chrono::milliseconds report_interval{50};

  /// Silent; can be cancelled only by `cancel`.
  Progress() = default;
  /// `cancel_flag`, if given, cancels as well when it turns true (a signal handler may set it); it
  /// must outlive this object.
  explicit Progress(Sink sink, const std::atomic<bool>* cancel_flag = nullptr)
      : sink_(std::move(sink)), cancel_flag_(cancel_flag) {}

  /// Ends the stage begun before, unless it is a `ProgressStage`, and begins one. Called by one
  /// thread.
  void begin(std::string stage, double total, std::string unit);
  /// Adds to what is done. Throws `Error(cancelled)` once cancelled. Any thread.
  void advance(double amount = 1);
  /// Throws `Error(cancelled)` once cancelled. Any thread; cheap enough for every row.
  void check() const;
  /// Sends the last report of the stage that `begin` began; what was before it goes on. Called by
  /// one thread.
  void end();

  void cancel() { cancelled_.store(true, std::memory_order_relaxed); }
  bool cancelled() const {
    return cancelled_.load(std::memory_order_relaxed) ||
           (cancel_flag_ != nullptr && cancel_flag_->load(std::memory_order_relaxed));
  }

 private:
  using Clock = std::chrono::steady_clock;
  friend class ProgressStage;

  struct Stage {
    std::string name;
    std::string unit;
    double total = 0;
    double done = 0;  ///< when an inner stage began
    Clock::time_point began{};
    bool scoped = false;  ///< ended by its ProgressStage alone
  };

  // With the mutex held:
  void push(Stage stage);
  void pop(bool told);
  void tell(bool finished);

  Sink sink_;
  const std::atomic<bool>* cancel_flag_ = nullptr;
  std::atomic<bool> cancelled_ = false;
  std::atomic<double> done_ = 0;
  std::mutex mutex_;           // guards what follows and calls of the sink
  std::vector<Stage> stages_;  // each within those before it
  std::atomic<Clock::time_point> last_report_{};
};

/// A stage from here to the end of the block, perhaps within another, which then goes on where it
/// was. Ends as well, without a report, when an exception passes.
class ProgressStage {
 public:
  /// Throws `Error(cancelled)` once cancelled. Called by one thread, as is the destructor.
  ProgressStage(Progress& progress, std::string stage, double total, std::string unit);
  ~ProgressStage();
  ProgressStage(const ProgressStage&) = delete;
  ProgressStage& operator=(const ProgressStage&) = delete;

 private:
  Progress& progress_;
  std::size_t outer_stages_ = 0;
  int exceptions_;  // in flight when it began
};

}  // namespace wold
