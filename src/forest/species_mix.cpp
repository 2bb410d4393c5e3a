#include "forest/species_mix.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "base/error.hpp"

namespace wold {

std::vector<double> species_shares(const Weights& weights, std::span<const SpeciesSettings> species,
                                   const char* owner) {
  std::vector<double> share(species.size(), weights.empty() ? 1.0 : 0.0);
  std::vector<std::string> names;
  for (const SpeciesSettings& s : species) names.push_back(s.name);
  for (const auto& [name, value] : weights) {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end())
      throw Error(ErrorKind::input,
                  fmt::format("'species' in '{}' names '{}', but no species is called that.{}",
                              owner, name, suggestion(name, names)));
    share[static_cast<std::size_t>(found - names.begin())] += value;
  }
  double sum = 0;
  for (const double s : share) sum += s;
  for (double& s : share) s = sum > 0 ? s / sum : 0;
  return share;
}

}  // namespace wold
