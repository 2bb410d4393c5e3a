#include "erosion/operators.hpp"

#include "erosion/dissolution.hpp"
#include "erosion/drainage.hpp"
#include "erosion/droplets.hpp"
#include "erosion/hillslope.hpp"
#include "erosion/layers.hpp"
#include "erosion/pipes.hpp"
#include "erosion/snow.hpp"
#include "erosion/stream_power.hpp"
#include "erosion/thermal.hpp"

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
                               .bytes_per_sample = 112}),
      terrain_operator(stream_power,
                       {.map_references = [](const StreamPower& p) -> std::vector<std::string> {
                          return {p.uplift_map, p.hardness, p.rain};
                        },
                        .maps = {"area", "flow", "wear", "sediment", "uplift"},
                        .bytes_per_sample = 88}),
      terrain_operator(thermal, {.map_references = [](const Thermal& p)
                                     -> std::vector<std::string> { return {p.hardness}; },
                                 .maps = {"wear", "sediment"},
                                 .bytes_per_sample = 64}),
      terrain_operator(snow, {.map_references = [](const Snow& p) -> std::vector<std::string> {
                                return {p.map};
                              },
                              .maps = {"snow"},
                              .bytes_per_sample = 64}),
      terrain_operator(dissolution,
                       {.map_references = [](const Dissolution& p) -> std::vector<std::string> {
                          return {p.rain_map, p.water, p.hardness};
                        },
                        .maps = {"water", "wear", "sediment", "carried"},
                        .bytes_per_sample = 64}),
      terrain_operator(layers, {.map_references = [](const Layers& p) -> std::vector<std::string> {
                                  return {p.water.rain_map, p.water.water, p.water.hardness};
                                },
                                .maps = {"water", "velocity", "velocity_x", "velocity_y", "wetness",
                                         "wear", "sediment", "carried", "layer", "strata", "loose"},
                                .bytes_per_sample = 144}),
  };
}

}  // namespace wold
