#include "plants/lsystem.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/hash.hpp"
#include "plants/context.hpp"

namespace wold {

namespace {

enum class Draw : std::uint8_t { constants, axiom, rewrite, choice };

constexpr std::int32_t copied = -1;

/// One derivation: the tables that stay the same, and the steps.
class Derivation {
 public:
  Derivation(const LSystem& system, std::uint64_t seed, const DeriveLimits& limits,
             Progress& progress)
      : system_(system),
        seed_(seed),
        limits_(limits),
        progress_(progress),
        constants_(evaluate_constants(system, seed)),
        by_symbol_(symbol_count) {
    for (std::size_t k = 0; k < system.productions.size(); ++k) {
      const Production& p = system.productions[k];
      by_symbol_[p.predecessor.symbol].push_back(static_cast<std::int32_t>(k));
      has_context_ = has_context_ || !p.left.empty() || !p.right.empty();
      for (const ModuleTemplate& m : p.successor) has_cut_ = has_cut_ || m.symbol == '%';
    }
    for (const ModuleTemplate& m : system.axiom) has_cut_ = has_cut_ || m.symbol == '%';
  }

  Word axiom() {
    Word word;
    append(system_.axiom, {constants_, {}, random_bits(seed_, Draw::axiom)}, word);
    if (has_cut_) cut(word);
    return word;
  }

  Word step(const Word& word, int number) {
    step_key_ = random_bits(seed_, Draw::rewrite, number);
    const ContextMatcher context(word, system_.ignored, has_context_);
    std::vector<std::int32_t> choices(word.modules.size(), copied);
    const Size size = choose(word, context, choices);
    check_size(size, number);
    Word next;
    next.modules.reserve(static_cast<std::size_t>(size.modules));
    next.values.reserve(static_cast<std::size_t>(size.values));
    rewrite(word, context, choices, next);
    if (has_cut_) cut(next);
    return next;
  }

 private:
  struct Size {
    std::int64_t modules = 0;
    std::int64_t values = 0;
  };

  std::uint64_t key(std::size_t place) const { return random_bits(step_key_, place); }

  /// Picks a production for every module, and sums the length of the word they make.
  Size choose(const Word& word, const ContextMatcher& context, std::vector<std::int32_t>& choices) {
    Size size;
    for (std::size_t place = 0; place < word.modules.size(); ++place) {
      if (place % 4096 == 0) progress_.check();
      const std::int32_t choice = production_for(word, context, place);
      choices[place] = choice;
      if (choice == copied) {
        size.modules += 1;
        size.values += word.modules[place].count;
        continue;
      }
      const Production& p = system_.productions[static_cast<std::size_t>(choice)];
      size.modules += std::ssize(p.successor);
      for (const ModuleTemplate& m : p.successor) size.values += std::ssize(m.arguments);
    }
    return size;
  }

  std::int32_t production_for(const Word& word, const ContextMatcher& context, std::size_t place) {
    candidates_.clear();
    for (const std::int32_t k : by_symbol_[word.modules[place].symbol]) {
      const Production& p = system_.productions[static_cast<std::size_t>(k)];
      if (!context.match(p, place, arguments_)) continue;
      const ExpressionInput input{constants_, arguments_, key(place)};
      // A condition is NaN when its values are; that is not a match.
      if (!p.condition.empty() && !(std::abs(p.condition.evaluate(input)) > 0)) continue;
      if (p.weight.empty()) {
        if (candidates_.empty()) return k;
        continue;
      }
      const double weight = p.weight.evaluate(input);
      if (!(weight >= 0) || !std::isfinite(weight))
        throw Error(
            ErrorKind::input,
            fmt::format("the weight of this production is {}, and must be 0 or more", weight),
            p.where);
      candidates_.emplace_back(k, weight);
    }
    return draw_candidate(key(place));
  }

  std::int32_t draw_candidate(std::uint64_t bits) const {
    double total = 0;
    for (const auto& [k, weight] : candidates_) total += weight;
    double u = total * uniform_double(random_bits(bits, Draw::choice));
    std::int32_t last = copied;
    for (const auto& [k, weight] : candidates_) {
      if (weight > 0) last = k;
      if (u < weight) return k;
      u -= weight;
    }
    return last;
  }

  void check_size(const Size& size, int number) const {
    if (size.modules <= limits_.max_modules && size.values <= 8 * limits_.max_modules) return;
    throw Error(ErrorKind::limit,
                fmt::format("after {} iterations the word would have {} modules and {} "
                            "parameters; the limit is {} and {}. Use fewer iterations",
                            number + 1, size.modules, size.values, limits_.max_modules,
                            8 * limits_.max_modules));
  }

  void rewrite(const Word& word, const ContextMatcher& context,
               const std::vector<std::int32_t>& choices, Word& next) {
    for (std::size_t place = 0; place < word.modules.size(); ++place) {
      if (place % 4096 == 0) progress_.check();
      if (choices[place] == copied) {
        Module m = word.modules[place];
        const auto values = word.parameters(m);
        m.first = static_cast<std::uint32_t>(next.values.size());
        next.values.insert(next.values.end(), values.begin(), values.end());
        next.modules.push_back(m);
        continue;
      }
      const Production& p = system_.productions[static_cast<std::size_t>(choices[place])];
      context.match(p, place, arguments_);
      append(p.successor, {constants_, arguments_, key(place)}, next);
    }
  }

  static void append(const std::vector<ModuleTemplate>& templates, const ExpressionInput& input,
                     Word& word) {
    for (const ModuleTemplate& t : templates) {
      word.modules.push_back({t.symbol, static_cast<std::uint16_t>(t.arguments.size()),
                              static_cast<std::uint32_t>(word.values.size())});
      for (const Expression& e : t.arguments) word.values.push_back(e.evaluate(input));
    }
  }

  /// Removes `%` and what follows it in its branch.
  static void cut(Word& word) {
    std::size_t kept = 0;
    int skipped_depth = -1;  // depth of brackets within what is skipped; -1: nothing is
    for (const Module& m : word.modules) {
      if (skipped_depth >= 0) {
        if (m.symbol == '[') ++skipped_depth;
        if (m.symbol != ']' || skipped_depth-- > 0) continue;
      } else if (m.symbol == '%') {
        skipped_depth = 0;
        continue;
      }
      word.modules[kept++] = m;
    }
    word.modules.resize(kept);
  }

  const LSystem& system_;
  std::uint64_t seed_;
  const DeriveLimits& limits_;
  Progress& progress_;
  std::vector<double> constants_;
  std::vector<std::vector<std::int32_t>> by_symbol_;
  bool has_context_ = false;
  bool has_cut_ = false;
  std::uint64_t step_key_ = 0;
  std::vector<std::pair<std::int32_t, double>> candidates_;
  std::vector<double> arguments_;
};

}  // namespace

std::string symbol_text(Symbol symbol) {
  const char c = static_cast<char>(symbol & 0xffU);
  if (symbol >= extension_symbol) return {'@', c};
  if (symbol >= organ_symbol) return {'~', c};
  return {c};
}

std::string to_text(const Word& word) {
  std::string text;
  for (const Module& m : word.modules) {
    text += symbol_text(m.symbol);
    if (m.count == 0) continue;
    text += fmt::format("({:.6g})", fmt::join(word.parameters(m), ", "));
  }
  return text;
}

std::vector<double> evaluate_constants(const LSystem& system, std::uint64_t seed) {
  std::vector<double> values;
  values.reserve(system.constants.size());
  for (const LSystem::Constant& c : system.constants)
    values.push_back(c.value.evaluate({values, {}, random_bits(seed, Draw::constants)}));
  return values;
}

Word derive(const LSystem& system, int iterations, std::uint64_t seed, const DeriveLimits& limits,
            Progress& progress) {
  Derivation derivation(system, seed, limits, progress);
  Word word = derivation.axiom();
  for (int step = 0; step < iterations; ++step) word = derivation.step(word, step);
  return word;
}

}  // namespace wold
