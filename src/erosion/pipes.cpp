#include "erosion/pipes.hpp"

#include "erosion/ground.hpp"
#include "erosion/pipes_storm.hpp"

namespace wold {

Description<Pipes> describe(const Pipes&) {
  return Description<Pipes>("pipes",
                            "Rain and springs run down the land, carve valleys and lay down fans; "
                            "rivers and lakes come out as maps.")
      .add("duration", &Pipes::duration, {.unit = "h", .min = 0, .max = 1e4},
           "How long it rains, on the coarsest grid; each finer one adds a quarter of that.")
      .add("rain", &Pipes::rain, {.unit = "mm/h", .min = 0, .max = 1e4}, "How much.")
      .add("rain_map", &Pipes::rain_map,
           "Map that multiplies the rain (0 to 1): a step, a map, a picture.")
      .add("spring_places", &Pipes::spring_places, {.unit = "m"},
           "Where springs rise: x and y of the first, x and y of the second, …")
      .add("spring_rates", &Pipes::spring_rates, {.unit = "m³/s", .min = 0, .max = 1e6},
           "How much water each spring gives.")
      .add("spring_radius", &Pipes::spring_radius, {.unit = "m", .min = 0, .max = 1e4},
           "Over how wide a place.")
      .add("water", &Pipes::water, "Map of the water's depth (m) at the beginning.")
      .add("lakes", &Pipes::lakes,
           "Whether hollows are full of water at the beginning (with an open border).")
      .add("evaporation", &Pipes::evaporation, {.unit = "1/h", .min = 0, .max = 1000},
           "Share of the water's depth that evaporates in an hour.")
      .choice(
          "border", &Pipes::border, {"open", "closed", "periodic"},
          "What happens to water at the border: it leaves, is held, or comes in again opposite.")
      .add("capacity", &Pipes::capacity, {.unit = "s", .min = 0, .max = 1000},
           "Ground that water carries at 1 m/s down a vertical slope, m; large values press ages "
           "into "
           "hours.")
      .add("full_depth", &Pipes::full_depth, {.unit = "m", .min = 0.0001, .max = 1000},
           "Water less deep than this carries less.")
      .add("least_slope", &Pipes::least_slope, {.unit = "degrees", .min = 0, .max = 45},
           "Flatter ground wears as if it were that steep.")
      .add("dissolving", &Pipes::dissolving, {.unit = "1/s", .min = 0, .max = 100},
           "How fast water takes up what it lacks.")
      .add("depositing", &Pipes::depositing, {.unit = "1/s", .min = 0, .max = 100},
           "How fast water lays down what it carries too much.")
      .add("bank_angle", &Pipes::bank_angle, {.unit = "degrees", .min = 1, .max = 89},
           "Banks that water cut steeper slide.")
      .add("stirring", &Pipes::stirring, {.min = 0, .max = 100},
           "How far what is carried strays down side slopes: wide, smooth river beds.")
      .add("hardness", &Pipes::hardness,
           "Map of what resists (0 to 1, white does not wear): a step, a map, a picture.")
      .add("hardness_invert", &Pipes::hardness_invert, "Whether black is hard instead.")
      .add("unevenness", &Pipes::unevenness, {.min = 0, .max = 3},
           "How much softer and harder spots differ: rivers wind round the hard ones.")
      .add("drag", &Pipes::drag, {.min = 0, .max = 10},
           "Friction at the bed: shear stress over density and squared speed.")
      .add("momentum", &Pipes::momentum,
           "Whether water carries its momentum along: steep rivers without ripples, at twice the "
           "work.")
      .add("pipe_depth", &Pipes::pipe_depth, {.unit = "m", .min = 0.01, .max = 1000},
           "Deeper water levels out as slowly as if it were that deep; longer steps for it.")
      .add("top_speed", &Pipes::top_speed, {.unit = "m/s", .min = 0.01, .max = 100},
           "Water is never faster.")
      .add("start_cell", &Pipes::start_cell, {.unit = "m", .min = 0, .max = 1e5},
           "Cell of the coarsest grid; 0: 128 cells across the land.");
}

TerrainResult pipes(const Heightfield& input, const Pipes& parameters,
                    const TerrainContext& context) {
  check_erosion(input, parameters);
  return pipes_detail::storm(input, parameters, context);
}

}  // namespace wold
