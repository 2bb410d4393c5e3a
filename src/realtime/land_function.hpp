#pragma once
// The terrain steps of a scene as one GLSL function of the place.
//
//   vec3 land(vec2 place, float spacing)    height (m) over the place, east and north of the
//                                           terrain's middle, and its derivative; features finer
//                                           than samples `spacing` metres apart would show are
//                                           left out, as in terrain/fractal_ground.hpp
//
// A step can be told so if the ground it makes at a place follows from the input at one place:
// fractals, warps, terraces, arithmetic, masks by height, slope and noise. What needs the whole
// land (erosion, imports, blurring) is left out, and with it what refers to it. Each octave's
// offset is split into a lattice cell and a place in it, in double precision here, so that 32 bits
// do in the shader.

#include <span>
#include <string>
#include <vector>

#include "terrain/steps.hpp"

namespace wold {

struct LandFunction {
  std::string text;  ///< GLSL that includes "terrain/fractal_ground.glsl" and "terrain/steps.glsl"
  std::vector<std::string> left_out;  ///< names of steps that change the ground, or operators
  float largest_feature = 1000;       ///< m
};

LandFunction land_function(const TerrainSettings& terrain, std::span<const TerrainStep> steps,
                           std::span<const TerrainOperator> operators, std::uint64_t seed);

/// A number as GLSL writes a float.
std::string glsl_number(double value);

}  // namespace wold
