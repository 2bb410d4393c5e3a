#include "plants/expression_parser.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

namespace wold {

namespace {

using Operation = Expression::Operation;

/// Precedence climbing, after Richards.
class Parser {
 public:
  Parser(StatementReader& reader, const ExpressionNames& names) : reader_(reader), names_(names) {}

  Expression parse() {
    binary(0);
    return Expression(std::move(code_));
  }

 private:
  struct Binary {
    std::string_view token;
    Operation operation;
    int precedence;
  };

  void emit(Operation operation, std::uint32_t index = 0, double number = 0) {
    const int operands = Expression::operands(operation);
    code_.push_back({operation, static_cast<std::uint8_t>(operands), index, number});
    depth_ += 1 - operands;
    if (depth_ > Expression::max_stack)
      throw Error(ErrorKind::limit, "this expression is too deep; use a define for a part of it",
                  reader_.location());
  }

  /// The operator that comes next, or null. An arrow is none, though it begins with a minus.
  const Binary* next_binary() {
    static constexpr Binary operators[] = {
        {"||", Operation::either, 1},     {"&&", Operation::both, 2},
        {"==", Operation::equal, 3},      {"!=", Operation::not_equal, 3},
        {"<=", Operation::less_equal, 3}, {">=", Operation::greater_equal, 3},
        {"<", Operation::less, 3},        {">", Operation::greater, 3},
        {"+", Operation::add, 4},         {"-", Operation::subtract, 4},
        {"*", Operation::multiply, 5},    {"/", Operation::divide, 5},
        {"%", Operation::remainder, 5},
    };
    if (reader_.at_end()) return nullptr;
    const std::string_view rest = reader_.rest();
    if (rest.starts_with("->") || rest.starts_with("-->")) return nullptr;
    for (const Binary& b : operators)
      if (rest.starts_with(b.token)) return &b;
    return nullptr;
  }

  void binary(int least) {
    if (++nesting_ > 200)
      throw Error(ErrorKind::limit, "this expression is too deep", reader_.location());
    unary();
    while (const Binary* b = next_binary()) {
      if (b->precedence < least) break;
      reader_.accept(b->token);
      binary(b->precedence + 1);
      emit(b->operation);
    }
    --nesting_;
  }

  void unary() {
    if (reader_.accept("-")) {
      guarded_unary();
      emit(Operation::negate);
    } else if (reader_.peek() == '!' && reader_.peek_second() != '=') {
      reader_.take();
      guarded_unary();
      emit(Operation::invert);
    } else {
      reader_.accept("+");
      primary();
      if (reader_.accept("^")) {
        guarded_unary();
        emit(Operation::power);
      }
    }
  }

  void guarded_unary() {
    if (++nesting_ > 200)
      throw Error(ErrorKind::limit, "this expression is too deep", reader_.location());
    unary();
    --nesting_;
  }

  void primary() {
    const char c = reader_.peek();
    if (reader_.accept("(")) {
      binary(0);
      reader_.expect(")");
    } else if (std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '.') {
      number();
    } else {
      named();
    }
  }

  void number() {
    const std::string_view rest = (reader_.offset(), reader_.rest());
    double value = 0;
    const auto [end, failure] = std::from_chars(rest.data(), rest.data() + rest.size(), value);
    if (failure != std::errc() || !std::isfinite(value)) reader_.fail_expected("a number");
    reader_.advance(static_cast<std::size_t>(end - rest.data()));
    emit(Operation::number, 0, value);
  }

  void named() {
    const std::size_t begin = reader_.offset();
    const std::string name = reader_.accept_name();
    if (name.empty()) reader_.fail_expected("a number, a name or '('");
    if (reader_.peek() == '(') return function(name, begin);
    const auto place = [&](std::span<const std::string> list) {
      return std::find(list.begin(), list.end(), name) - list.begin();
    };
    const auto argument = place(names_.arguments);
    const auto constant = place(names_.constants);
    if (argument < std::ssize(names_.arguments)) {
      emit(Operation::argument, static_cast<std::uint32_t>(argument));
    } else if (constant < std::ssize(names_.constants)) {
      emit(Operation::constant, static_cast<std::uint32_t>(constant));
    } else {
      unknown(name, begin);
    }
  }

  [[noreturn]] void unknown(const std::string& name, std::size_t begin) {
    std::vector<std::string> known(names_.arguments.begin(), names_.arguments.end());
    known.insert(known.end(), names_.constants.begin(), names_.constants.end());
    throw Error(ErrorKind::input,
                fmt::format("'{}' is neither a parameter here nor defined above.{}", name,
                            suggestion(name, known)),
                reader_.location(begin));
  }

  void function(const std::string& name, std::size_t begin) {
    const auto functions = Expression::functions();
    const auto f = std::find_if(functions.begin(), functions.end(),
                                [&](const auto& candidate) { return candidate.name == name; });
    if (f == functions.end()) {
      std::vector<std::string> known;
      for (const auto& candidate : functions) known.emplace_back(candidate.name);
      throw Error(ErrorKind::input,
                  fmt::format("unknown function '{}'.{}", name, suggestion(name, known)),
                  reader_.location(begin));
    }
    const bool random = f->operation == Operation::uniform || f->operation == Operation::normal;
    if (random && names_.random_place == nullptr)
      throw Error(ErrorKind::input, "a setting cannot be random; only modules and defines can",
                  reader_.location(begin));
    reader_.expect("(");
    for (int k = 0; k < f->arguments; ++k) {
      if (k > 0 && !reader_.accept(","))
        reader_.fail_expected(fmt::format("',' ({} takes {} arguments)", name, f->arguments));
      binary(0);
    }
    if (!reader_.accept(")"))
      reader_.fail_expected(fmt::format("')' ({} takes {} arguments)", name, f->arguments));
    emit(f->operation, random ? (*names_.random_place)++ : 0);
  }

  StatementReader& reader_;
  const ExpressionNames& names_;
  std::vector<Expression::Instruction> code_;
  int depth_ = 0;
  int nesting_ = 0;
};

}  // namespace

Expression parse_expression(StatementReader& reader, const ExpressionNames& names) {
  return Parser(reader, names).parse();
}

}  // namespace wold
