#pragma once
// The syntax of Wavefront OBJ: lines, words, numbers and corners of faces; used by all that reads
// it.

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <string>
#include <string_view>

#include "base/error.hpp"

namespace wold {

/// The statements of a text, one after the other. A backslash at the end of a line goes on with
/// the next; a comment ends the line. All views are into the text.
class ObjLines {
 public:
  ObjLines(std::string_view text, const std::string& file) : rest_(text), where_{file, 0, 0} {}

  /// Goes on to the next line; false at the end.
  bool next();
  std::string_view line() const { return line_; }
  const SourceLocation& where() const { return where_; }
  [[noreturn]] void fail(const std::string& message) const {
    throw Error(ErrorKind::input, message, where_);
  }

  /// Takes the first word off a line; empty if there is none.
  static std::string_view take_word(std::string_view& line);
  /// Without blanks at either end.
  static std::string_view trimmed(std::string_view text);

  template <class Float>
  Float number(std::string_view word) const {
    std::string_view digits = word;
    if (!digits.empty() && digits.front() == '+') digits.remove_prefix(1);
    Float value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    // Denormal numbers are out of range too; they are as good as 0.
    if (error == std::errc::invalid_argument || end != digits.data() + digits.size())
      fail(fmt::format("'{}' is not a number", word));
    return value;
  }

  /// Of one corner: position, texture coordinates, normal, counted from 0; -1 for none.
  struct Corner {
    std::array<int, 3> index{-1, -1, -1};
    std::string_view normal;  ///< the word's part that names the normal
  };
  /// "7", "7/2", "7//3", "7/2/3"; counted from 1, or backwards from the last if negative. `counts`
  /// of each are defined before this line.
  Corner corner(std::string_view word, const std::array<std::size_t, 3>& counts) const;

 private:
  int index(std::string_view digits, std::string_view word, std::size_t count) const;

  std::string_view rest_;
  std::string_view line_;
  SourceLocation where_;
  int lines_taken_ = 1;
};

}  // namespace wold
