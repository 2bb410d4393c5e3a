#include "terrain/operator.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace wold {

const TerrainResult& TerrainContext::step(std::string_view name) const {
  const auto found = named.find(std::string(name));
  if (found != named.end()) return found->second;
  std::vector<std::string> names;
  for (const auto& entry : named) names.push_back(entry.first);
  throw Error(ErrorKind::input,
              fmt::format("no step named '{}' before this one.{}", name, suggestion(name, names)));
}

const TerrainOperator& find_operator(std::span<const TerrainOperator> operators,
                                     std::string_view name, const SourceLocation& where) {
  const auto found = std::find_if(operators.begin(), operators.end(),
                                  [&](const TerrainOperator& op) { return op.name() == name; });
  if (found != operators.end()) return *found;
  std::vector<std::string> names;
  for (const TerrainOperator& op : operators) names.push_back(op.name());
  throw Error(ErrorKind::input,
              fmt::format("unknown terrain operator '{}'.{}", name, suggestion(name, names)),
              where);
}

}  // namespace wold
