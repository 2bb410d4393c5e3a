#pragma once
// What every command of the program shares: its common options, its messages, its progress.

#include <atomic>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/progress.hpp"

namespace CLI {
class App;
}

namespace wold {

using Json = nlohmann::ordered_json;

/// The options that mean the same in every command, and where messages go.
struct Session {
  bool quiet = false;
  bool json = false;
  int threads = 0;
  std::string seed;                   ///< as given; empty: the scene's
  std::vector<std::string> settings;  ///< of --set
  const std::atomic<bool>* interrupted = nullptr;

  /// Adds --quiet, --json and --threads.
  void add_output_options(CLI::App& command);
  /// Adds --seed and --set.
  void add_scene_options(CLI::App& command);

  /// The overrides of --seed and --set, for the scene's reader. Throws Error(usage) for a seed that
  /// is none.
  std::vector<std::string> overrides() const;
  /// A line on standard error, unless quiet.
  void say(const std::string& line) const;
  /// Shows progress on standard error: a bar on a terminal, a line every few seconds elsewhere.
  Progress progress() const;
  /// Prints the one object of --json on standard output.
  void print(const Json& report) const;
};

/// Text on standard error. Never fails: a terminal that went away costs messages, not the picture.
void write_error(const std::string& text);
/// Text on standard output; main reports what could not be written.
void write_output(const std::string& text);

/// "1.2 s", "3 min 20 s".
std::string duration_text(double seconds);
/// "950", "12.3 k", "4.5 M".
std::string count_text(double count);
/// Largest resident size of this process so far, bytes.
double peak_memory();

}  // namespace wold
