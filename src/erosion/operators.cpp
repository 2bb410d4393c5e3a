#include "erosion/operators.hpp"

namespace wold {

OperatorList erosion_operators() {
  return {};
}

}  // namespace wold
