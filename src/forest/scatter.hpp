#pragma once
// Plants over the land: which stands where.
//
// Candidates fall on the whole plane as a Poisson process: each cell of a lattice fixed to the
// world has a random number of them, hashed from the seed and the cell. Each has a random rank;
// large kinds rank first. It stays if the place suits it (suitability.hpp) and its circle touches
// none that stays with a higher rank (spacing.hpp): "random sequential adsorption", or Matérn's
// third process, blue noise whose result is a property of the plane, not of an order of evaluation.
// Tiles find it exactly: a tile is computed with a margin, what depends on anything beyond the
// margin is marked uncertain, and the margin is doubled until nothing inside is. So the same plants
// stand in any window, with any number of threads.
//
// `density` is plants per square metre of map where all suits; it is met within 3 % unless the
// circles cannot lie so densely (SpacingPlan::reached tells). Plants of two scatters do not see
// each other.

#include <cstdint>
#include <span>
#include <vector>

#include "base/parameters.hpp"
#include "base/progress.hpp"
#include "forest/instance.hpp"
#include "forest/spacing.hpp"
#include "forest/species.hpp"
#include "forest/suitability.hpp"
#include "terrain/heightfield.hpp"

namespace wold {

struct ScatterSettings {
  Weights species;          ///< empty: all alike
  double density = 0.02;    ///< per m²
  float evenness = 0.7F;    ///< distance kept, as a share of the most that the density allows
  float patchiness = 0.5F;  ///< how much the mix of species changes over the land
  float patch_size = 60;    ///< m
  SuitabilitySettings where;
  FilePath mask;
  Range scale{0.85F, 1.15F};
  float align = 0;     ///< 0 upright, 1 along the normal of the ground
  float tilt = 2;      ///< degrees, at most
  float sink = 0.03F;  ///< m
};

Description<ScatterSettings> describe(const ScatterSettings&);

/// What part of the world, and around what.
struct ScatterPlace {
  DVec2 low{-1e9};  ///< m; the window is [low, high)
  DVec2 high{1e9};
  DVec2 centre{0};                    ///< of `within`
  const Heightfield* mask = nullptr;  ///< 0 to 1, or null; who calls reads the file `mask`
};

/// How the circles of the chosen species fit. Kind k is the k-th of `species` with the density that
/// its weight asks for. Throws Error(input) for a name that no species has.
SpacingPlan plan_scatter(const ScatterSettings& settings, std::span<const SpeciesSettings> species);

/// Where `scatter` with this seed lets plants stand, and how densely. Refers to the ground and the
/// place's mask.
SuitabilityMap scatter_suitability(const Heightfield& ground, const ScatterSettings& settings,
                                   const ScatterPlace& place, std::uint64_t seed);

/// All plants in the window, in an order fixed by their places. `Instance::species` counts in
/// `species`. Throws as plan_scatter, Error(limit) when they would not fit in memory, and
/// Error(cancelled).
std::vector<Instance> scatter(const Heightfield& ground, const ScatterSettings& settings,
                              std::span<const SpeciesSettings> species, const ScatterPlace& place,
                              std::uint64_t seed, Progress& progress);

}  // namespace wold
