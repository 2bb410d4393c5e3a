#include "plants/expression.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "base/hash.hpp"
#include "base/smoothstep.hpp"
#include "base/vec.hpp"

namespace wold {

namespace {

using Operation = Expression::Operation;

constexpr std::array<Expression::Function, 26> function_table{{
    {"sin", Operation::sin, 1},
    {"cos", Operation::cos, 1},
    {"tan", Operation::tan, 1},
    {"asin", Operation::asin, 1},
    {"acos", Operation::acos, 1},
    {"atan", Operation::atan, 1},
    {"atan2", Operation::atan2, 2},
    {"sqrt", Operation::sqrt, 1},
    {"exp", Operation::exp, 1},
    {"log", Operation::log, 1},
    {"pow", Operation::power, 2},
    {"abs", Operation::abs, 1},
    {"sign", Operation::sign, 1},
    {"floor", Operation::floor, 1},
    {"ceil", Operation::ceil, 1},
    {"round", Operation::round, 1},
    {"min", Operation::min, 2},
    {"max", Operation::max, 2},
    {"mix", Operation::mix, 3},
    {"clamp", Operation::clamp, 3},
    {"smoothstep", Operation::smoothstep, 3},
    {"if", Operation::choose, 3},
    {"rand", Operation::uniform, 2},
    {"random", Operation::uniform, 2},
    {"uniform", Operation::uniform, 2},
    {"normal", Operation::normal, 2},
}};

/// Box and Muller; cut at three deviations, so that no single branch is absurd.
double standard_normal(std::uint64_t bits) {
  const double u = 1 - uniform_double(bits);
  const double v = uniform_double(mix_bits(bits));
  return std::clamp(std::sqrt(-2 * std::log(u)) * std::cos(2 * pi_d * v), -3.0, 3.0);
}

double apply_unary(Operation operation, double a) {
  switch (operation) {
    case Operation::negate: return -a;
    case Operation::invert: return a == 0 ? 1 : 0;
    case Operation::sin: return std::sin(radians(a));
    case Operation::cos: return std::cos(radians(a));
    case Operation::tan: return std::tan(radians(a));
    case Operation::asin: return degrees(std::asin(a));
    case Operation::acos: return degrees(std::acos(a));
    case Operation::atan: return degrees(std::atan(a));
    case Operation::sqrt: return std::sqrt(a);
    case Operation::exp: return std::exp(a);
    case Operation::log: return std::log(a);
    case Operation::abs: return std::abs(a);
    case Operation::sign: return a > 0 ? 1 : (a < 0 ? -1 : 0);
    case Operation::floor: return std::floor(a);
    case Operation::ceil: return std::ceil(a);
    default: return std::round(a);
  }
}

double apply_binary(Operation operation, double a, double b) {
  switch (operation) {
    case Operation::add: return a + b;
    case Operation::subtract: return a - b;
    case Operation::multiply: return a * b;
    case Operation::divide: return a / b;
    case Operation::remainder: return std::fmod(a, b);
    case Operation::power: return std::pow(a, b);
    case Operation::less: return a < b ? 1 : 0;
    case Operation::less_equal: return a <= b ? 1 : 0;
    case Operation::greater: return a > b ? 1 : 0;
    case Operation::greater_equal: return a >= b ? 1 : 0;
    case Operation::equal: return a == b ? 1 : 0;
    case Operation::not_equal: return a != b ? 1 : 0;
    case Operation::both: return a != 0 && b != 0 ? 1 : 0;
    case Operation::either: return a != 0 || b != 0 ? 1 : 0;
    case Operation::atan2: return degrees(std::atan2(a, b));
    case Operation::min: return std::min(a, b);
    default: return std::max(a, b);
  }
}

double apply_ternary(Operation operation, double a, double b, double c) {
  switch (operation) {
    case Operation::mix: return a + (b - a) * c;
    case Operation::clamp: return std::min(std::max(a, b), c);
    case Operation::smoothstep: return smoothstep(a, b, c);
    default: return a != 0 ? b : c;
  }
}

double draw_random(const Expression::Instruction& i, double a, double b, std::uint64_t key) {
  const std::uint64_t bits = random_bits(key, i.index);
  return i.operation == Operation::uniform ? a + (b - a) * uniform_double(bits)
                                           : a + b * standard_normal(bits);
}

}  // namespace

std::span<const Expression::Function> Expression::functions() {
  return function_table;
}

int Expression::operands(Operation operation) {
  if (operation <= Operation::argument) return 0;
  if (operation == Operation::negate || operation == Operation::invert) return 1;
  for (const Function& f : function_table)
    if (f.operation == operation) return f.arguments;
  return 2;
}

double Expression::evaluate(const ExpressionInput& input) const {
  std::array<double, max_stack> stack;
  std::size_t top = 0;
  for (const Instruction& i : code_) {
    switch (i.operation) {
      case Operation::number: stack[top++] = i.number; continue;
      case Operation::constant: stack[top++] = input.constants[i.index]; continue;
      case Operation::argument: stack[top++] = input.arguments[i.index]; continue;
      default: break;
    }
    switch (i.operands) {
      case 1: stack[top - 1] = apply_unary(i.operation, stack[top - 1]); break;
      case 2: {
        const double b = stack[--top];
        double& a = stack[top - 1];
        const bool random = i.operation == Operation::uniform || i.operation == Operation::normal;
        a = random ? draw_random(i, a, b, input.random_key) : apply_binary(i.operation, a, b);
        break;
      }
      default:
        top -= 2;
        stack[top - 1] = apply_ternary(i.operation, stack[top - 1], stack[top], stack[top + 1]);
    }
  }
  assert(top == 1);
  return stack[0];
}

}  // namespace wold
