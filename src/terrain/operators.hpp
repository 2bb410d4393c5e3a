#pragma once
// All operators of this room.

#include "terrain/operator.hpp"

namespace wold {

OperatorList terrain_operators();

}  // namespace wold
