#pragma once
// Arithmetic over the parameters of a grammar, compiled to postfix code.
//
// Operators, from weak to strong: || && then == != < <= > >= then + - then * / % then unary - !
// then ^ (power, to the right). Angles are in degrees. Functions: sin cos tan asin acos atan atan2
// sqrt exp log pow abs sign floor ceil round min max mix(a, b, t) clamp(x, low, high)
// smoothstep(low, high, x) if(condition, a, b) rand(a, b) (uniform) normal(mean, deviation).
// A comparison is 1 or 0. Division by zero and the like give infinities or NaN, which whoever uses
// the value refuses.

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace wold {

/// What an expression may look at.
struct ExpressionInput {
  std::span<const double> constants;  ///< the values of `define`s
  std::span<const double> arguments;  ///< of the modules that a production matched
  std::uint64_t random_key = 0;       ///< rand and normal are hashes of this and of their place
};

class Expression {
 public:
  enum class Operation : std::uint8_t {
    number,
    constant,
    argument,
    add,
    subtract,
    multiply,
    divide,
    remainder,
    power,
    negate,
    less,
    less_equal,
    greater,
    greater_equal,
    equal,
    not_equal,
    both,
    either,
    invert,
    sin,
    cos,
    tan,
    asin,
    acos,
    atan,
    atan2,
    sqrt,
    exp,
    log,
    abs,
    sign,
    floor,
    ceil,
    round,
    min,
    max,
    mix,
    clamp,
    smoothstep,
    choose,
    uniform,
    normal
  };
  struct Instruction {
    Operation operation = Operation::number;
    std::uint8_t operands = 0;  ///< values taken from the stack
    std::uint32_t index = 0;    ///< of a constant or argument; the place of a random number
    double number = 0;
  };
  struct Function {
    std::string_view name;
    Operation operation;
    int arguments;
  };
  /// All functions by name.
  static std::span<const Function> functions();
  /// How many values an operation takes from the stack.
  static int operands(Operation operation);
  static constexpr int max_stack = 64;

  Expression() = default;
  explicit Expression(double number) : code_{{Operation::number, 0, 0, number}} {}
  /// `code` must be a well-formed postfix expression of at most `max_stack` depth.
  explicit Expression(std::vector<Instruction> code) : code_(std::move(code)) {}

  bool empty() const { return code_.empty(); }
  double evaluate(const ExpressionInput& input) const;

 private:
  std::vector<Instruction> code_;
};

}  // namespace wold
