#pragma once
// All operators of this room.

#include "terrain/operator.hpp"

namespace wold {

OperatorList erosion_operators();

}  // namespace wold
