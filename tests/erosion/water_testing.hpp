#pragma once
// What the tests of pipes, layers and dissolution share.

#include "testing.hpp"

namespace wold::testing_water {

using namespace testing_erosion;

inline double bumps(DVec2 x) {
  return 40 * std::sin(x.x / 70) * std::cos(x.y / 90) + 12 * std::sin(x.x / 23 + x.y / 31);
}

/// Hills with hollows, 500 m above the scene's zero.
inline Heightfield hills(int width, int height, double cell) {
  return field_of(width, height, cell, {0, 0}, [](DVec2 x) {
    return 500 + 0.1 * x.x + bumps(x) + 3 * std::sin(x.x / 7) * std::sin(x.y / 9);
  });
}

inline void expect_balanced(const TerrainResult& result) {
  testing_erosion::expect_balanced(result, {"ground", "water"});
}

}  // namespace wold::testing_water
