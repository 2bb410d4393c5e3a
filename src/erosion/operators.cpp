#include "erosion/operators.hpp"

#include "erosion/drainage.hpp"
#include "erosion/droplets.hpp"
#include "erosion/hillslope.hpp"
#include "erosion/pipes.hpp"
#include "erosion/stream_power.hpp"

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
      terrain_operator(hillslope,
                       {.reach = [](const Hillslope& p, double cell) { return reach_of(p, cell); },
                        .maps = {"change"},
                        .bytes_per_sample = 32}),
      terrain_operator(pipes, {.map_references = [](const Pipes& p) -> std::vector<std::string> {
                                 return {p.rain_map, p.water, p.hardness};
                               },
                               .maps = {"water", "velocity", "velocity_x", "velocity_y", "wetness",
                                        "wear", "sediment", "carried"},
                               .bytes_per_sample = 96}),
      terrain_operator(stream_power,
                       {.map_references = [](const StreamPower& p) -> std::vector<std::string> {
                          return {p.uplift_map, p.hardness, p.rain};
                        },
                        .maps = {"area", "flow", "wear", "sediment", "uplift"},
                        .bytes_per_sample = 88}),
  };
}

}  // namespace wold
