#pragma once
// The program run as a user runs it: its own process, its own folder, its output caught.

#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace wold::testing {

struct Outcome {
  int exit_code = -1;  ///< 128 + signal when a signal ended it
  std::string out;
  std::string err;
  double seconds = 0;  ///< from start, or from the signal, to the end
};

/// A folder for one test, with a small scene and a small plant in it, removed at the end.
class Workplace {
 public:
  Workplace();
  ~Workplace();
  Workplace(const Workplace&) = delete;
  Workplace& operator=(const Workplace&) = delete;

  std::filesystem::path path(const std::string& name) const { return folder_ / name; }
  /// In the program's folder for temporary files.
  std::filesystem::path temporary(const std::string& name) const;
  void write(const std::string& name, const std::string& text) const;
  std::string read(const std::string& name) const;
  bool has(const std::string& name) const { return std::filesystem::exists(path(name)); }
  /// Names of all files, sorted, joined by spaces.
  std::string files() const;

  /// Runs `wold ARGUMENTS…` here. Files such as /dev/full may stand in for the two streams.
  Outcome run(const std::vector<std::string>& arguments, const std::string& stdout_to = {},
              const std::string& stderr_to = {}) const;
  /// Runs it, sends the signal once its standard error contains `sign` (at once, or after
  /// `seconds`, for an empty one), and waits.
  Outcome interrupt(const std::vector<std::string>& arguments, int signal, const std::string& sign,
                    double seconds = 0) const;
  /// Runs it, calls `action` once its standard error contains `sign`, and waits.
  Outcome during(const std::vector<std::string>& arguments, const std::string& sign,
                 const std::function<void()>& action) const;
  /// Runs it where no file may grow beyond this.
  Outcome run_with_files_up_to(std::size_t bytes, const std::vector<std::string>& arguments) const;

 private:
  using Action = std::function<void(pid_t)>;

  pid_t start(const std::vector<std::string>& arguments, const std::string& out,
              const std::string& err) const;
  Outcome act(const std::vector<std::string>& arguments, const std::string& sign, double seconds,
              const Action& action) const;

  std::filesystem::path folder_;
};

/// Hills with trees that is built in a tenth of a second.
extern const char* const small_scene;

}  // namespace wold::testing
