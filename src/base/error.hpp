#pragma once
// Errors: what is wrong, where, and what would be right. The library throws `Error` and never
// prints; the program prints `file:line:column: error: message`.

#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace wold {

enum class ErrorKind {
  usage,      ///< the caller asked for something that does not exist (exit code 2)
  input,      ///< a file or a value in it is wrong
  io,         ///< reading or writing failed
  limit,      ///< would not fit in memory or exceeds a stated limit
  cancelled,  ///< stopped on request (exit code 130)
  internal    ///< a defect in wold
};

/// A place in a text that a user wrote. Line and column count from 1; 0 means unknown.
struct SourceLocation {
  std::string file;
  int line = 0;
  int column = 0;

  bool known() const { return !file.empty(); }
  /// "scene.toml:12:9", without the parts that are unknown.
  std::string text() const;
};

class Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, std::string message, SourceLocation location = {});

  ErrorKind kind() const { return kind_; }
  /// Without the location.
  const std::string& message() const { return message_; }
  const SourceLocation& location() const { return location_; }
  /// The same error, at a place, if it had none.
  Error at(const SourceLocation& location) const;

 private:
  ErrorKind kind_;
  std::string message_;
  SourceLocation location_;
};

/// Number of single-character edits (insert, delete, replace, swap neighbours) between two words.
int edit_distance(std::string_view a, std::string_view b);

/// The candidate that `word` was probably meant to be, or an empty string.
std::string closest_name(std::string_view word, std::span<const std::string> candidates);

/// " Did you mean 'x'?" or, when nothing is near, " Known: a, b, c." (an empty string for no
/// candidates). To be put behind a message.
std::string suggestion(std::string_view word, std::span<const std::string> candidates);

}  // namespace wold
