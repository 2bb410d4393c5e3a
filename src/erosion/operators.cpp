#include "erosion/operators.hpp"

#include "erosion/drainage.hpp"
#include "erosion/droplets.hpp"
#include "erosion/pipes.hpp"

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
      terrain_operator(pipes,
                       {.map_references = [](const Pipes& p) -> std::vector<std::string> {
                          return {p.rain_map, p.water, p.hardness};
                        },
                        .maps = {"water", "velocity", "velocity_x", "velocity_y", "wetness", "wear",
                                 "sediment", "carried"},
                        .bytes_per_sample = 96}),
  };
}

}  // namespace wold
