#include "erosion/operators.hpp"

#include "erosion/drainage.hpp"
#include "erosion/droplets.hpp"

namespace wold {

OperatorList erosion_operators() {
  return {
      terrain_operator(drainage, {.maps = {"area", "flow", "wetness", "lakes", "basins", "order"},
                                  .bytes_per_sample = 48}),
      terrain_operator(droplets,
                       {.map_references = [](const Droplets& p) -> std::vector<std::string> {
                          return {p.hardness, p.rain_map};
                        },
                        .maps = {"flow", "discharge", "velocity", "wear", "sediment", "color.red",
                                 "color.green", "color.blue"},
                        .bytes_per_sample = 40}),
  };
}

}  // namespace wold
