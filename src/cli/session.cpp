#include "cli/session.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>

#include "base/error.hpp"

namespace wold {

namespace {

constexpr int bar_width = 28;
constexpr std::chrono::seconds line_interval{5};  // in a pipe
constexpr std::uint64_t largest_seed = 1ULL << 53U;
constexpr double least_shown = 0.4;  // s; stages shorter than this are not worth a line

std::string amounts(const ProgressReport& r) {
  const double rate = r.seconds > 0 ? r.done / r.seconds : 0;
  std::string text;
  if (rate > 0 && !r.unit.empty()) text += fmt::format(" {} {}/s", count_text(rate), r.unit);
  if (rate > 0 && r.total > r.done)
    text += fmt::format(", {} left", duration_text((r.total - r.done) / rate));
  return text;
}

std::string bar(const ProgressReport& r) {
  if (r.total <= 0) return fmt::format("{} … {}", r.stage, duration_text(r.seconds));
  const double share = std::min(1.0, r.done / r.total);
  const int full = static_cast<int>(share * bar_width);
  return fmt::format(
      "{} [{}{}] {:3.0f} %{}", r.stage, std::string(static_cast<std::size_t>(full), '='),
      std::string(static_cast<std::size_t>(bar_width - full), ' '), 100 * share, amounts(r));
}

/// Of a stage within another it is the other that counts.
void tell_duration(const ProgressReport& r) {
  if (!r.inner && r.seconds >= least_shown)
    write_error(fmt::format("{}: {}\n", r.stage, duration_text(r.seconds)));
}

/// On a terminal one line is drawn again and again.
void draw(const ProgressReport& r) {
  if (r.finished) {
    write_error("\r\033[K");
    tell_duration(r);
  } else {
    write_error(fmt::format("\r{}\033[K", bar(r)));
  }
}

class LinePrinter {
 public:
  void operator()(const ProgressReport& r) {
    if (r.finished) return tell_duration(r);
    const auto now = std::chrono::steady_clock::now();
    if (now - last_ < line_interval) return;
    last_ = now;
    std::string text = r.total > 0 ? fmt::format(" {:.0f} %", 100 * r.done / r.total) : "";
    text += amounts(r);
    if (text.empty()) text = " " + duration_text(r.seconds) + " so far";
    write_error(fmt::format("{}:{}\n", r.stage, text));
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace

void Session::add_output_options(CLI::App& command) {
  command.add_flag("-q,--quiet", quiet, "No messages and no progress; errors are still shown");
  command.add_flag("--json", json, "Print one JSON object about what was done on standard output");
  command
      .add_option("--threads", threads,
                  "Threads to work with; the result is the same for any number")
      ->check(CLI::Range(1, 4096))
      ->type_name("N");
}

void Session::add_scene_options(CLI::App& command) {
  command.add_option("--seed", seed, "Another number gives another landscape")->type_name("N");
  command
      .add_option("--set", settings,
                  "Set any value of the scene, such as terrain.size=8000 or species.birch.models=3")
      ->type_name("PATH=VALUE")
      ->allow_extra_args(false);
}

std::vector<std::string> Session::overrides() const {
  std::vector<std::string> list;
  if (!seed.empty()) {
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(seed.data(), seed.data() + seed.size(), value);
    if (error != std::errc() || end != seed.data() + seed.size() || value > largest_seed)
      throw Error(ErrorKind::usage,
                  fmt::format("'--seed {}' must be an integer, 0 to {}", seed, largest_seed));
    list.push_back("seed=" + seed);
  }
  list.insert(list.end(), settings.begin(), settings.end());
  return list;
}

void Session::say(const std::string& line) const {
  if (!quiet) write_error(line + "\n");
}

Progress Session::progress() const {
  if (quiet) return Progress({}, interrupted);
  if (isatty(STDERR_FILENO) != 0) return Progress(draw, interrupted);
  return Progress([printer = LinePrinter()](const ProgressReport& r) mutable { printer(r); },
                  interrupted);
}

void Session::print(const Json& report) const {
  if (json) write_output(report.dump(2) + "\n");
}

void write_error(const std::string& text) {
  std::fputs(text.c_str(), stderr);
  std::fflush(stderr);
}

void write_output(const std::string& text) {
  std::fputs(text.c_str(), stdout);
}

std::string duration_text(double seconds) {
  if (seconds < 10) return fmt::format("{:.1f} s", seconds);
  if (seconds < 60) return fmt::format("{:.0f} s", seconds);
  const long whole = std::lround(seconds);
  if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
  return fmt::format("{} h {} min", whole / 3600, whole % 3600 / 60);
}

std::string count_text(double count) {
  if (count >= 1e9) return fmt::format("{:.1f} G", count / 1e9);
  if (count >= 1e6) return fmt::format("{:.1f} M", count / 1e6);
  if (count >= 1e4) return fmt::format("{:.0f} k", count / 1e3);
  return fmt::format("{:.0f}", count);
}

double peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

}  // namespace wold
