#include "plants/grammar_parser.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string_view>
#include <utility>

#include "plants/expression_parser.hpp"

namespace wold {

namespace {

/// Characters that cannot be symbols because the notation needs them.
constexpr std::string_view reserved = "(),:<>=*";

bool arrow_next(StatementReader& reader) {
  reader.offset();
  return reader.rest().starts_with("->") || reader.rest().starts_with("-->");
}

void expect_arrow(StatementReader& reader) {
  if (!reader.accept("-->") && !reader.accept("->")) reader.fail_expected("'->'");
}

/// "p1:" in front of a production.
void skip_label(StatementReader& reader) {
  const std::size_t begin = reader.offset();
  const std::string label = reader.accept_name();
  if (label.size() < 2 || !reader.accept(":")) reader.rewind(begin);
}

/// Every bracket and brace in a word must have its partner there.
void check_balance(const std::vector<ModuleTemplate>& word, const SourceLocation& where) {
  std::string open;
  for (const ModuleTemplate& m : word) {
    if (m.symbol == '[' || m.symbol == '{') open += static_cast<char>(m.symbol);
    if (m.symbol != ']' && m.symbol != '}') continue;
    const char partner = m.symbol == ']' ? '[' : '{';
    if (open.empty() || open.back() != partner)
      throw Error(ErrorKind::input,
                  fmt::format("'{}' without '{}'", static_cast<char>(m.symbol), partner), where);
    open.pop_back();
  }
  if (!open.empty())
    throw Error(ErrorKind::input, fmt::format("'{}' is never closed", open.back()), where);
}

}  // namespace

Symbol GrammarParser::symbol(StatementReader& reader) {
  const char c = reader.peek();
  if (c == '\0' || reserved.find(c) != std::string_view::npos ||
      static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) > 0x7e)
    reader.fail_expected("a module");
  reader.take();
  if (c != '~' && c != '@') return static_cast<Symbol>(c);
  const std::string_view rest = reader.rest();
  if (rest.empty() || std::isalnum(static_cast<unsigned char>(rest.front())) == 0)
    reader.fail_expected(fmt::format("a letter directly after '{}'", c));
  const char name = rest.front();
  reader.advance(1);
  return static_cast<Symbol>((c == '~' ? organ_symbol : extension_symbol) + name);
}

ModulePattern GrammarParser::pattern(StatementReader& reader,
                                     std::vector<std::string>& parameters) {
  ModulePattern p;
  p.symbol = symbol(reader);
  if (!reader.accept("(")) return p;
  do {
    const SourceLocation where = reader.location();
    std::string name = reader.accept_name();
    if (name.empty()) reader.fail_expected("the name of a parameter");
    if (std::find(parameters.begin(), parameters.end(), name) != parameters.end())
      throw Error(ErrorKind::input, fmt::format("the parameter '{}' appears twice", name), where);
    parameters.push_back(std::move(name));
    ++p.count;
  } while (reader.accept(","));
  if (!reader.accept(")")) reader.fail_expected("',' or ')'");
  return p;
}

Expression GrammarParser::expression(StatementReader& reader,
                                     const std::vector<std::string>& parameters) {
  return parse_expression(reader, {constant_names_, parameters, &random_places_});
}

std::vector<ModuleTemplate> GrammarParser::word(StatementReader& reader,
                                                const std::vector<std::string>& parameters) {
  std::vector<ModuleTemplate> modules;
  const SourceLocation where = reader.location();
  while (!reader.at_end() && reader.peek() != ':') {
    ModuleTemplate m;
    m.symbol = symbol(reader);
    if (reader.accept("(")) {
      do m.arguments.push_back(expression(reader, parameters));
      while (reader.accept(","));
      if (!reader.accept(")")) reader.fail_expected("',', ')' or an operator");
    }
    modules.push_back(std::move(m));
  }
  check_balance(modules, where);
  return modules;
}

void GrammarParser::define(StatementReader& reader) {
  const SourceLocation where = reader.location();
  const std::string name = reader.accept_name();
  if (name.empty()) reader.fail_expected("a name to define");
  if (std::find(constant_names_.begin(), constant_names_.end(), name) != constant_names_.end())
    throw Error(ErrorKind::input, fmt::format("'{}' is defined twice", name), where);
  reader.accept("=");
  system_.constants.push_back({name, expression(reader, {}), where});
  constant_names_.push_back(name);
}

void GrammarParser::ignore(StatementReader& reader) {
  reader.accept(":");
  if (reader.at_end()) reader.fail_expected("the symbols to ignore");
  while (!reader.at_end()) system_.ignored.push_back(symbol(reader));
}

void GrammarParser::axiom(StatementReader& reader) {
  if (has_axiom())
    throw Error(ErrorKind::input, "there is already an axiom above", reader.location());
  reader.expect(":");
  system_.axiom = word(reader, {});
  if (!has_axiom()) reader.fail_expected("a word");
}

void GrammarParser::production(StatementReader& reader) {
  skip_label(reader);
  Production p;
  p.where = reader.location();
  std::vector<std::string> parameters;
  std::vector<ModulePattern> patterns{pattern(reader, parameters)};
  const auto more = [&] {
    while (!reader.at_end() && !arrow_next(reader) &&
           std::string_view(":<>").find(reader.peek()) == std::string_view::npos)
      patterns.push_back(pattern(reader, parameters));
  };
  more();
  if (reader.accept("<")) {
    p.left = std::exchange(patterns, {});
    patterns.push_back(pattern(reader, parameters));
    more();
  }
  if (patterns.size() != 1)
    throw Error(ErrorKind::input, "a production replaces exactly one module", p.where);
  p.predecessor = patterns.front();
  if (reader.accept(">")) {
    patterns = {pattern(reader, parameters)};
    more();
    p.right = std::move(patterns);
  }
  if (reader.accept(":") && !reader.accept("*")) p.condition = expression(reader, parameters);
  expect_arrow(reader);
  p.successor = word(reader, parameters);
  if (reader.accept(":")) p.weight = expression(reader, parameters);
  system_.productions.push_back(std::move(p));
}

}  // namespace wold
