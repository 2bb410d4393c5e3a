#pragma once
// Moves the ground sideways by noise, so that straight and even shapes become winding:
//   h(p) = input(p + distance · (n1(p), n2(p)))

#include "terrain/operator.hpp"

namespace wold {

struct Warp {
  float distance = 100;       ///< m, how far at most
  float feature_size = 1000;  ///< m, size of the bends
  int octaves = 2;
};

Description<Warp> describe(const Warp&);

Heightfield warp(const Heightfield& input, const Warp& parameters, const TerrainContext& context);

/// How far outside a place the input matters there, m.
double reach_of(const Warp& parameters, double cell);

}  // namespace wold
