#include "erosion/droplets.hpp"

#include "erosion/droplet_run.hpp"
#include "erosion/ground.hpp"

namespace wold {

Description<Droplets> describe(const Droplets&) {
  using D = Droplets;
  return Description<D>("droplets",
                        "Water erosion by drops that run downhill, take up ground where they are "
                        "fast and lay it down where they slow.")
      .choice("variant", &D::variant, {"slope", "momentum"},
              "How drops move: their direction bends to the slope, or the slope accelerates them "
              "along each axis; the latter's capacity depends on their speed alone.")
      .add("rain", &D::rain, {.unit = "drops/m²", .min = 0, .max = 1e4},
           "How many drops fall. More of them erode more, and take longer.")
      .add("distance", &D::distance, {.unit = "m", .min = 0, .max = 1e6},
           "How far a drop runs at most.")
      .add("inertia", &D::inertia, {.unit = "m", .min = 0, .max = 1e5},
           "The way on which a slope of 45 degrees turns a drop; 0 follows the steepest descent.")
      .add("scatter", &D::scatter, {.unit = "degrees", .min = 0, .max = 30},
           "The largest turn at random between two samples; 0 leaves streaks along their rows.")
      .add("capacity", &D::capacity, {.unit = "m³", .min = 0, .max = 1e9},
           "What a drop can carry at 1 m/s on a slope of 45 degrees.")
      .add("min_slope", &D::min_slope, {.min = 0, .max = 10},
           "Flatter ground counts as this (rise over run) for what a drop can carry.")
      .add("erosion", &D::erosion, {.unit = "1/m", .min = 0, .max = 1e4},
           "How fast a drop takes up what it could still carry.")
      .add("deposition", &D::deposition, {.unit = "1/m", .min = 0, .max = 1e4},
           "How fast a drop lays down what it cannot carry.")
      .add("evaporation", &D::evaporation, {.unit = "1/m", .min = 0, .max = 1e4},
           "Share of its water that a drop loses on the way.")
      .add("gravity", &D::gravity, {.unit = "m/s²", .min = 0, .max = 1e3}, "Acceleration downhill.")
      .add("drag", &D::drag, {.unit = "1/m", .min = 0, .max = 1e4},
           "Share of its speed that a drop loses on the way.")
      .add("max_speed", &D::max_speed, {.unit = "m/s", .min = 0, .max = 1e4},
           "No drop runs faster.")
      .add("max_drop", &D::max_drop, {.unit = "m", .min = 0, .max = 1e5},
           "A step of the ground between samples higher than this does not accelerate.")
      .add("radius", &D::radius, {.unit = "m", .min = 0, .max = 1e4},
           "Width of a drop's effect; 0: the four samples around it.")
      .add("bank_slope", &D::bank_slope, {.unit = "degrees", .min = 1, .max = 90},
           "Banks that drops cut steeper than this slide; 90: none do.")
      .add("creep", &D::creep, {.unit = "m", .min = 0, .max = 1e3},
           "What is laid down is loose: it spreads by about this until the rain ends.")
      .add("hardness", &D::hardness, "A map of what resists: white does not erode.")
      .add("hardness_invert", &D::hardness_invert, "Black resists, not white.")
      .add("rain_map", &D::rain_map, "A map of where it rains: white; on black no drops fall.")
      .add("closed_border", &D::closed_border,
           "Drops cannot leave: they run along the border and lay down what they carry.")
      .add("contrast", &D::contrast, {.min = 0, .max = 1},
           "Of the flow map: low shows where most of the water goes after few passes, high only "
           "large streams.")
      .add("color", &D::color, "A picture laid over the terrain, whose colours drops carry along.")
      .add("color_depth", &D::color_depth, {.unit = "m", .min = 1e-3, .max = 1e3},
           "Depth of the ground that has mixed colours: less changes faster.");
}

TerrainResult droplets(const Heightfield& input, const Droplets& parameters,
                       const TerrainContext& context) {
  check_erosion(input, parameters);
  context.progress.begin("ground for droplets", 0, "");
  DropletRun run(input, parameters, context);
  run.rain();
  return run.result();
}

}  // namespace wold
