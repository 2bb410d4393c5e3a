#pragma once
// Names with weights, as a scene gives them, against the list of species.

#include <span>
#include <vector>

#include "base/value.hpp"
#include "forest/species.hpp"

namespace wold {

/// The share of each species, all together 1; without names all alike. All 0 when no weight is
/// positive. Throws Error(input), naming `owner`, for a name that no species has.
std::vector<double> species_shares(const Weights& weights, std::span<const SpeciesSettings> species,
                                   const char* owner);

}  // namespace wold
