#include "erosion/operators.hpp"

#include "erosion/drainage.hpp"

namespace wold {

OperatorList erosion_operators() {
  return {
      terrain_operator(drainage, {.maps = {"area", "flow", "wetness", "lakes", "basins", "order"},
                                  .bytes_per_sample = 48}),
  };
}

}  // namespace wold
