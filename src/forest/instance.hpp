#pragma once
// One plant in the world: which model, where, how turned. Millions of them are kept at once.

#include <cstdint>

#include "base/vec.hpp"

namespace wold {

struct Instance {
  Vec3 position{0};              ///< m, foot of the plant
  Vec3 up{0, 0, 1};              ///< unit, direction of its stem
  float yaw = 0;                 ///< radians, about its stem
  float scale = 1;               ///< of its model
  std::uint32_t individual = 0;  ///< random, its own for ever: for tints
  std::uint16_t species = 0;     ///< place in the list of species
  std::uint16_t model = 0;       ///< which model of its species

  friend bool operator==(const Instance&, const Instance&) = default;
};
static_assert(sizeof(Instance) == 40);

}  // namespace wold
