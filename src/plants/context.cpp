#include "plants/context.hpp"

namespace wold {

ContextMatcher::ContextMatcher(const Word& word, const std::vector<Symbol>& ignored,
                               bool with_context)
    : word_(&word), ignored_(symbol_count, false) {
  for (const Symbol s : ignored) ignored_[s] = true;
  if (!with_context) return;
  partner_.assign(word.modules.size(), word.modules.size());
  Places open;
  for (std::size_t k = 0; k < word.modules.size(); ++k) {
    if (word.modules[k].symbol == '[') open.push_back(k);
    if (word.modules[k].symbol != ']' || open.empty()) continue;
    partner_[k] = open.back();
    partner_[open.back()] = k;
    open.pop_back();
  }
}

bool ContextMatcher::fits(const ModulePattern& pattern, std::size_t place) const {
  const Module& m = word_->modules[place];
  return m.symbol == pattern.symbol && m.count == pattern.count;
}

bool ContextMatcher::match(const Production& production, std::size_t place,
                           std::vector<double>& arguments) const {
  if (!fits(production.predecessor, place)) return false;
  arguments.clear();
  const auto collect = [&](std::size_t p) {
    const auto values = word_->parameters(word_->modules[p]);
    arguments.insert(arguments.end(), values.begin(), values.end());
  };
  if (production.left.empty() && production.right.empty()) {
    collect(place);
    return true;
  }
  Places left;
  Places right;
  if (!match_left(production.left, place, left)) return false;
  if (!match_right(production.right, 0, place + 1, right)) return false;
  for (auto p = left.rbegin(); p != left.rend(); ++p) collect(*p);
  collect(place);
  for (const std::size_t p : right) collect(p);
  return true;
}

bool ContextMatcher::match_left(const std::vector<ModulePattern>& patterns, std::size_t place,
                                Places& found) const {
  for (auto pattern = patterns.rbegin(); pattern != patterns.rend(); ++pattern) {
    for (;;) {
      if (place == 0) return false;
      --place;
      const Symbol s = word_->modules[place].symbol;
      if (s == ']') {
        if (partner_[place] == word_->modules.size()) return false;
        place = partner_[place];
      } else if (s != '[' && !ignored(place)) {
        break;
      }
    }
    if (!fits(*pattern, place)) return false;
    found.push_back(place);
  }
  return true;
}

bool ContextMatcher::match_right(const std::vector<ModulePattern>& patterns, std::size_t next,
                                 std::size_t place, Places& found) const {
  const std::size_t end = word_->modules.size();
  for (; next < patterns.size(); ++next) {
    const Symbol wanted = patterns[next].symbol;
    while (place < end && ignored(place)) ++place;
    if (wanted == '[') return match_branch(patterns, next, place, found);
    // The rest of a branch need not be named; its end is where its parent goes on.
    while (place < end && (ignored(place) || word_->modules[place].symbol == '[')) {
      if (!ignored(place)) place = partner_[place];
      if (place < end) ++place;
    }
    if (wanted == ']') continue;
    if (place >= end || !fits(patterns[next], place)) return false;
    found.push_back(place++);
  }
  return true;
}

bool ContextMatcher::match_branch(const std::vector<ModulePattern>& patterns, std::size_t next,
                                  std::size_t place, Places& found) const {
  std::size_t close = next + 1;
  for (int depth = 1; close < patterns.size(); ++close) {
    if (patterns[close].symbol == '[') ++depth;
    if (patterns[close].symbol == ']' && --depth == 0) break;
  }
  if (close >= patterns.size()) return false;
  const std::vector<ModulePattern> inner(patterns.begin() + static_cast<std::ptrdiff_t>(next) + 1,
                                         patterns.begin() + static_cast<std::ptrdiff_t>(close));
  // The named branch may be any of those that begin here.
  const std::size_t kept = found.size();
  for (const std::size_t end = word_->modules.size(); place < end;) {
    if (ignored(place)) {
      ++place;
      continue;
    }
    if (word_->modules[place].symbol != '[' || partner_[place] == end) break;
    if (match_right(inner, 0, place + 1, found) &&
        match_right(patterns, close + 1, partner_[place] + 1, found))
      return true;
    found.resize(kept);
    place = partner_[place] + 1;
  }
  return false;
}

}  // namespace wold
