#pragma once
// Smooths the ground with a Gaussian of standard deviation `distance`, cut off at four of them.
// Blurring twice is blurring once with the root of the sum of squares.

#include "terrain/operator.hpp"

namespace wold {

struct Blur {
  float distance = 20;  ///< m, standard deviation
};

Description<Blur> describe(const Blur&);

Heightfield blur(const Heightfield& input, const Blur& parameters, const TerrainContext& context);

/// How far outside a place the input matters there, m.
double reach_of(const Blur& parameters, double cell);

/// What lies outside a grid.
enum class Outside {
  clamp,  ///< the nearest value on its border
  mirror  ///< its mirror image, again and again
};

/// A grid smoothed by a Gaussian of `deviation` samples.
Grid<float> blurred(const Grid<float>& in, double deviation, Progress& progress,
                    Outside outside = Outside::clamp);

}  // namespace wold
