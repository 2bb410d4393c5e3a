#pragma once
// Files that are written after long work: an error in writing one costs neither the others nor the
// work.

#include <functional>
#include <string>
#include <vector>

namespace wold {

class Delivery {
 public:
  /// Calls `write` with a path to write a file or a folder to: `path`, and if that fails the same
  /// name in the current folder, then in that for temporary files; nothing that is there already is
  /// replaced then. Returns the path that was written, empty if none could be.
  std::string write(const std::string& path,
                    const std::function<void(const std::string& path)>& write);

  bool complete() const { return failures_.empty(); }

  /// To be called after the last file: throws Error(io) if any could not be written where it was
  /// wanted, which says why, and where it is instead.
  void check() const;

 private:
  std::vector<std::string> failures_;
};

}  // namespace wold
