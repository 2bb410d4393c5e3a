#pragma once
// Parametric, bracketed, stochastic, context-sensitive L-systems: parallel rewriting of a word.
//
// In each step every module A(x1, …, xn) is replaced by the successor of the production that
// matches its symbol, its number of parameters, its neighbours and a condition. Of several that
// match, the first is taken; if that has a weight, one is drawn among all that match and have one,
// with probability proportional to weight. A module that no production matches is copied. `%` in a
// successor removes what follows to the end of its branch.
//
// Left context is the path to the root: branches in between are skipped. Right context may name
// branches, A > B[C]D; branches it does not name are skipped. Symbols in `ignored` are skipped in
// both.
//
// Random numbers are hashes of (seed, step, place in the word, which), so a word depends on nothing
// else.
//
// P. Prusinkiewicz, A. Lindenmayer, The Algorithmic Beauty of Plants, Springer 1990, sections 1.2
// to 1.10. Where the book leaves open what two matching productions without probabilities do, the
// first wins.

#include <cstdint>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/progress.hpp"
#include "plants/expression.hpp"

namespace wold {

/// A symbol: a character, or `~X` and `@X`, whose second character is a name.
using Symbol = std::uint16_t;
inline constexpr Symbol organ_symbol = 0x100;      ///< + X for `~X`
inline constexpr Symbol extension_symbol = 0x200;  ///< + X for `@X`

std::string symbol_text(Symbol symbol);

struct Module {
  Symbol symbol = 0;
  std::uint16_t count = 0;  ///< of parameters
  std::uint32_t first = 0;  ///< where they begin in `Word::values`
};

struct Word {
  std::vector<Module> modules;
  std::vector<double> values;

  std::span<const double> parameters(const Module& m) const {
    return std::span<const double>(values).subspan(m.first, m.count);
  }
};

/// The word as a user would write it: "F(1)[+A(2, 0.5)]".
std::string to_text(const Word& word);

struct ModulePattern {
  Symbol symbol = 0;
  int count = 0;  ///< of parameters
};

struct ModuleTemplate {
  Symbol symbol = 0;
  std::vector<Expression> arguments;
};

struct Production {
  std::vector<ModulePattern> left;
  ModulePattern predecessor;
  std::vector<ModulePattern> right;  ///< may hold brackets
  Expression condition;              ///< empty: always
  std::vector<ModuleTemplate> successor;
  Expression weight;  ///< empty: not stochastic
  SourceLocation where;
};

struct LSystem {
  struct Constant {
    std::string name;
    Expression value;  ///< of earlier constants and random numbers: drawn once per model
    SourceLocation where;
  };
  std::vector<Constant> constants;
  std::vector<Symbol> ignored;
  std::vector<ModuleTemplate> axiom;
  std::vector<Production> productions;
};

struct DeriveLimits {
  std::int64_t max_modules = 8'000'000;
};

/// The values of all constants for a seed.
std::vector<double> evaluate_constants(const LSystem& system, std::uint64_t seed);

/// The word after `iterations` steps. Throws Error(limit) before a word longer than the limit is
/// built, Error(input) for a weight that is not a number >= 0, Error(cancelled).
Word derive(const LSystem& system, int iterations, std::uint64_t seed, const DeriveLimits& limits,
            Progress& progress);

}  // namespace wold
