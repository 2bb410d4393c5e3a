#pragma once
// A plant file cut into statements, and a reader of one statement that knows where it is.
//
// One statement a line; a line that begins with a blank continues the one before. `//` begins a
// comment at the start of a line or after a blank (elsewhere it is two rolls of the turtle).

#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"

namespace wold {

struct Statement {
  struct Piece {
    std::size_t offset = 0;  ///< where a line begins in `text`
    int line = 0;
    int column = 0;
  };
  std::string text;
  std::vector<Piece> pieces;
  std::string file;

  SourceLocation location(std::size_t offset) const;
};

std::vector<Statement> split_statements(std::string_view text, const std::string& file);

/// Reads a statement from left to right. All functions skip blanks first.
class StatementReader {
 public:
  explicit StatementReader(const Statement& statement) : statement_(&statement) {}

  bool at_end();
  /// The next character, or 0 at the end.
  char peek();
  /// The character after the next one, blanks included; 0 at the end.
  char peek_second();
  char take();
  /// Takes `token` if it comes next.
  bool accept(std::string_view token);
  /// Takes `token` or throws Error(input).
  void expect(std::string_view token);
  /// Takes letters, digits and '_' that begin with a letter; empty if there are none.
  std::string accept_name();
  /// Takes characters up to the next blank.
  std::string take_word();

  std::size_t offset();
  void rewind(std::size_t offset) { offset_ = offset; }
  SourceLocation location() { return statement_->location(offset()); }
  SourceLocation location(std::size_t place) const { return statement_->location(place); }
  std::string_view rest() const { return std::string_view(statement_->text).substr(offset_); }
  void advance(std::size_t count) { offset_ += count; }

  /// What comes next, for messages: "'+'", "'rnd'" or "the end of the line".
  std::string found();
  /// "expected X, found Y" at the next character.
  [[noreturn]] void fail_expected(const std::string& expected);

 private:
  const Statement* statement_;
  std::size_t offset_ = 0;
};

}  // namespace wold
