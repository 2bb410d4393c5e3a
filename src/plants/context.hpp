#pragma once
// Matching a production against a module and its neighbours in a bracketed word (ABOP, section
// 1.8).

#include <vector>

#include "plants/lsystem.hpp"

namespace wold {

inline constexpr std::size_t symbol_count = 0x300;

class ContextMatcher {
 public:
  /// `word` must outlive this. `with_context` false saves the tables when no production has any.
  ContextMatcher(const Word& word, const std::vector<Symbol>& ignored, bool with_context);

  /// Whether symbols, numbers of parameters and neighbours match; then `arguments` holds the
  /// parameters of left context, predecessor and right context in order.
  bool match(const Production& production, std::size_t place, std::vector<double>& arguments) const;

 private:
  using Places = std::vector<std::size_t>;

  bool fits(const ModulePattern& pattern, std::size_t place) const;
  bool ignored(std::size_t place) const { return ignored_[word_->modules[place].symbol]; }
  bool match_left(const std::vector<ModulePattern>& patterns, std::size_t place,
                  Places& found) const;
  bool match_right(const std::vector<ModulePattern>& patterns, std::size_t next, std::size_t place,
                   Places& found) const;
  bool match_branch(const std::vector<ModulePattern>& patterns, std::size_t next, std::size_t place,
                    Places& found) const;

  const Word* word_;
  std::vector<bool> ignored_;
  std::vector<std::size_t> partner_;  ///< of each bracket; the end of the word if it has none
};

}  // namespace wold
