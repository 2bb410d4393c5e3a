#pragma once
// A species: a plant file and what its individuals have in common; and its grown models.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/mesh.hpp"
#include "base/parameters.hpp"
#include "base/progress.hpp"
#include "plants/plant.hpp"

namespace wold {

struct SpeciesSettings {
  std::string name;
  FilePath plant;
  Range height{8, 14};  ///< m
  int models = 5;
  float radius = 0;  ///< m; 0: by height
  float detail = 1;
  float tint = 0.15F;

  /// Within this distance of its foot, in metres, no circle of another plant reaches.
  float exclusion_radius() const {
    return radius > 0 ? radius : 0.06F * (height.low + height.high);
  }
};

Description<SpeciesSettings> describe(const SpeciesSettings&);

struct Species {
  SpeciesSettings settings;
  Plant plant;
  std::vector<TriangleMesh> models;
};

/// Height of model `k`: the middle of its share of the range, so that all sizes are there.
float model_height(const SpeciesSettings& settings, int k);

/// Reads the plant files and grows all models, in parallel. A model depends on the seed, the name
/// of its species and its number alone. Throws Error(input) for a species without name or plant or
/// with the name of another, and as `load_plant` and `grow`.
std::vector<Species> grow_species(std::span<const SpeciesSettings> settings, std::uint64_t seed,
                                  Progress& progress);

}  // namespace wold
