#include "base/progress.hpp"

#include "base/error.hpp"

namespace wold {

ProgressReport Progress::report(bool finished) const {
  const std::chrono::duration<double> seconds = Clock::now() - began_;
  return {stage_, unit_, done_.load(), total_, seconds.count(), finished};
}

void Progress::begin(std::string stage, double total, std::string unit) {
  check();
  end();
  const std::lock_guard lock(mutex_);
  stage_ = std::move(stage);
  unit_ = std::move(unit);
  total_ = total;
  done_ = 0;
  began_ = Clock::now();
  last_report_ = began_;
  if (sink_) sink_(report(false));
}

void Progress::advance(double amount) {
  check();
  done_.fetch_add(amount, std::memory_order_relaxed);
  if (!sink_ || Clock::now() - last_report_.load() < report_interval) return;
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (!lock.owns_lock()) return;
  last_report_ = Clock::now();
  sink_(report(false));
}

void Progress::check() const {
  if (cancelled()) throw Error(ErrorKind::cancelled, "cancelled");
}

void Progress::end() {
  const std::lock_guard lock(mutex_);
  if (stage_.empty()) return;
  if (sink_) sink_(report(true));
  stage_.clear();
}

}  // namespace wold
