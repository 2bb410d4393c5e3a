#pragma once
// The statements of a grammar: define, ignore, axiom and productions.
//
//   define NAME = EXPRESSION
//   ignore SYMBOLS
//   axiom: WORD
//   [LABEL:] [LEFT <] PREDECESSOR [> RIGHT] [: CONDITION] -> WORD [: WEIGHT]
//
// A label has at least two characters, so that it is not taken for a module.

#include <cstdint>
#include <string>
#include <vector>

#include "plants/lsystem.hpp"
#include "plants/statement.hpp"

namespace wold {

class GrammarParser {
 public:
  /// Each reads what follows the keyword. They throw Error(input).
  void define(StatementReader& reader);
  void ignore(StatementReader& reader);
  void axiom(StatementReader& reader);
  void production(StatementReader& reader);

  bool has_axiom() const { return !system_.axiom.empty(); }
  LSystem take() { return std::move(system_); }

 private:
  Symbol symbol(StatementReader& reader);
  ModulePattern pattern(StatementReader& reader, std::vector<std::string>& parameters);
  std::vector<ModuleTemplate> word(StatementReader& reader,
                                   const std::vector<std::string>& parameters);
  Expression expression(StatementReader& reader, const std::vector<std::string>& parameters);

  LSystem system_;
  std::vector<std::string> constant_names_;
  std::uint32_t random_places_ = 0;
};

}  // namespace wold
