#pragma once
// Work on a thread of its own, for programs that must not wait: begun, watched, cancelled, and
// asked for its result.
//
//   BackgroundJob<Terrain> job;
//   job.begin([&](Progress& progress) { return evaluate(…, progress); });
//   …each frame: if (auto outcome = job.take()) …

#include <memory>
#include <mutex>
#include <new>
#include <optional>
#include <thread>
#include <utility>
#include <variant>

#include "base/error.hpp"
#include "base/progress.hpp"

namespace wold {

template <class T>
class BackgroundJob {
 public:
  /// What came of it: a result or an error.
  using Outcome = std::variant<T, Error>;

  BackgroundJob() = default;
  ~BackgroundJob() { stop(); }
  BackgroundJob(const BackgroundJob&) = delete;
  BackgroundJob& operator=(const BackgroundJob&) = delete;

  /// Begins; cancels what went on before and drops its outcome. `work(Progress&)` returns a T;
  /// what it refers to must live until the job is done.
  template <class Work>
  void begin(Work work) {
    stop();
    progress_ = std::make_unique<Progress>([this](const ProgressReport& report) {
      const std::scoped_lock lock(mutex_);
      report_ = report;
    });
    report_ = {};
    busy_ = true;
    thread_ = std::thread([this, work = std::move(work)]() mutable {
      Outcome outcome = run(work);
      const std::scoped_lock lock(mutex_);
      outcome_.emplace(std::move(outcome));
    });
  }

  /// Begun, and its outcome not yet taken.
  bool busy() const { return busy_; }
  /// The newest report.
  ProgressReport report() const {
    const std::scoped_lock lock(mutex_);
    return report_;
  }
  /// Asks it to end; its outcome will be Error(cancelled), or a result if it was nearly done.
  void cancel() {
    if (progress_) progress_->cancel();
  }
  /// The outcome, once, when it is there.
  std::optional<Outcome> take() {
    if (!busy_) return std::nullopt;
    {
      const std::scoped_lock lock(mutex_);
      if (!outcome_) return std::nullopt;
    }
    thread_.join();
    busy_ = false;
    return std::exchange(outcome_, std::nullopt);
  }
  /// Waits for it: throws its error.
  T wait() {
    thread_.join();
    busy_ = false;
    Outcome outcome = std::move(*outcome_);
    outcome_.reset();
    if (auto* error = std::get_if<Error>(&outcome)) throw *error;
    return std::get<T>(std::move(outcome));
  }

 private:
  template <class Work>
  Outcome run(Work& work) {
    try {
      return Outcome(std::in_place_index<0>, work(*progress_));
    } catch (const Error& error) {
      return Outcome(std::in_place_index<1>, error);
    } catch (const std::bad_alloc&) {
      return Outcome(std::in_place_index<1>, ErrorKind::limit, "the memory does not suffice");
    } catch (const std::exception& error) {
      return Outcome(std::in_place_index<1>, ErrorKind::internal, error.what());
    }
  }
  void stop() {
    if (!thread_.joinable()) return;
    cancel();
    thread_.join();
    busy_ = false;
    outcome_.reset();
  }

  std::unique_ptr<Progress> progress_;
  mutable std::mutex mutex_;  // guards report_ and outcome_
  ProgressReport report_;
  std::optional<Outcome> outcome_;
  bool busy_ = false;
  std::thread thread_;
};

}  // namespace wold
