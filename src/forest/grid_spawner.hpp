#pragma once
// A rectangular grid of plants around the camera or a place of the world: each cell, with a
// probability, gets one plant of a random species, at a random place within a share of the cell
// around its middle.

#include <cstdint>
#include <span>
#include <vector>

#include "base/parameters.hpp"
#include "forest/instance.hpp"
#include "forest/species.hpp"
#include "terrain/heightfield.hpp"

namespace wold {

/// What the middle of a grid is set off from.
enum class GridCentre { camera, world };

struct GridSpawner {
  GridCentre around = GridCentre::camera;
  Weights species;  ///< empty: all alike
  IVec2 cells{1, 1};
  float cell_size = 3;  ///< m
  Vec2 offset{0};       ///< m
  float probability = 1;
  float position_spread = 0.5F;
  Range scale{0.5F, 2};
};

Description<GridSpawner> describe(const GridSpawner&);

/// The middle of the grid stands at `centre` + offset. Plants outside the ground are left out. Cell
/// by cell from the south-west; a plant depends on the seed and its cell in the grid alone. Throws
/// Error(input) for a name that no species has and Error(limit) when there are too many cells.
std::vector<Instance> spawn_grid(const Heightfield& ground, const GridSpawner& spawner,
                                 std::span<const SpeciesSettings> species, DVec2 centre,
                                 std::uint64_t seed);

}  // namespace wold
