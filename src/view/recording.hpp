#pragma once
// A session at the viewer as a text file, one line for each frame, so that a flight can be flown
// again bit for bit:
//
//   wold recording 1
//   0.0166 look=0.01,-0.002 wheel=1 held=forward,faster pressed=reload
//
// The seconds stand first; what is zero or empty is left out. Numbers are written so that they read
// back as the same bits.

#include <cstdio>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "view/controls.hpp"

namespace wold {

std::string recording_line(const Controls& controls);

/// Reads a recording. `source` stands in messages. Throws Error(input) with file and line.
std::vector<Controls> parse_recording(std::string_view text, const std::string& source);

/// Throws Error(io) as well.
std::vector<Controls> read_recording(const std::string& file);

/// Writes a recording frame by frame: a session that breaks off leaves what there was of it.
class Recorder {
 public:
  /// Throws Error(io).
  explicit Recorder(const std::string& file);
  /// Throws Error(io) when the disk is full.
  void add(const Controls& controls);

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::string name_;
  std::unique_ptr<std::FILE, Close> file_;
};

}  // namespace wold
