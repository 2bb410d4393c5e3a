#include "base/progress.hpp"

#include <exception>
#include <utility>

#include "base/error.hpp"

namespace wold {

void Progress::begin(std::string stage, double total, std::string unit) {
  check();
  const std::lock_guard lock(mutex_);
  if (!stages_.empty() && !stages_.back().scoped) pop(true);
  push({.name = std::move(stage), .unit = std::move(unit), .total = total});
}

void Progress::advance(double amount) {
  check();
  done_.fetch_add(amount, std::memory_order_relaxed);
  if (!sink_ || Clock::now() - last_report_.load() < report_interval) return;
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (lock.owns_lock()) tell(false);
}

void Progress::check() const {
  if (cancelled()) throw Error(ErrorKind::cancelled, "cancelled");
}

void Progress::end() {
  const std::lock_guard lock(mutex_);
  if (!stages_.empty() && !stages_.back().scoped) pop(true);
}

void Progress::push(Stage stage) {
  if (!stages_.empty()) stages_.back().done = done_.load();
  stage.began = Clock::now();
  stages_.push_back(std::move(stage));
  done_ = 0;
  tell(false);
}

void Progress::pop(bool told) {
  if (told) tell(true);
  stages_.pop_back();
  done_ = stages_.empty() ? 0 : stages_.back().done;
}

void Progress::tell(bool finished) {
  if (stages_.empty()) return;
  const auto now = Clock::now();
  last_report_ = now;
  if (!sink_) return;
  const Stage& s = stages_.back();
  const std::chrono::duration<double> seconds = now - s.began;
  sink_({s.name, s.unit, done_.load(), s.total, seconds.count(), finished, stages_.size() > 1});
}

ProgressStage::ProgressStage(Progress& progress, std::string stage, double total, std::string unit)
    : progress_(progress), exceptions_(std::uncaught_exceptions()) {
  progress.check();
  const std::lock_guard lock(progress.mutex_);
  outer_stages_ = progress.stages_.size();
  progress.push(
      {.name = std::move(stage), .unit = std::move(unit), .total = total, .scoped = true});
}

ProgressStage::~ProgressStage() {
  const bool told = std::uncaught_exceptions() == exceptions_;
  const std::lock_guard lock(progress_.mutex_);
  while (progress_.stages_.size() > outer_stages_) progress_.pop(told);
}

}  // namespace wold
