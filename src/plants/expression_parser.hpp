#pragma once
// From text to Expression.

#include <cstdint>
#include <span>
#include <string>

#include "plants/expression.hpp"
#include "plants/statement.hpp"

namespace wold {

/// Names that an expression may use. Each call of `rand` or `normal` takes the next `random_place`.
struct ExpressionNames {
  std::span<const std::string> constants;
  std::span<const std::string> arguments;  ///< these hide constants of the same name
  std::uint32_t* random_place = nullptr;   ///< null: no random numbers here
};

/// Reads one expression and stops behind it. Throws Error(input).
Expression parse_expression(StatementReader& reader, const ExpressionNames& names);

}  // namespace wold
