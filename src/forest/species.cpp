#include "forest/species.hpp"

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/hash.hpp"
#include "base/parallel.hpp"

namespace wold {

Description<SpeciesSettings> describe(const SpeciesSettings&) {
  return Description<SpeciesSettings>("species", "A kind of plant: its file, sizes and models.")
      .add("name", &SpeciesSettings::name, "What the scatters call it.")
      .add("plant", &SpeciesSettings::plant, "The plant file it grows from.")
      .add("height", &SpeciesSettings::height, {.unit = "m", .min = 0.01, .max = 200},
           "Height of the grown plants.")
      .add("models", &SpeciesSettings::models, {.min = 1, .max = 1000},
           "Number of different individuals; instances share them.")
      .add("radius", &SpeciesSettings::radius, {.unit = "m", .min = 0, .max = 100},
           "Circle around the foot that it keeps free of others; 0: 0.12 of the height.")
      .add("detail", &SpeciesSettings::detail, {.min = 0.05, .max = 4},
           "Fineness of the models; below 1 fewer triangles.")
      .add("tint", &SpeciesSettings::tint, {.min = 0, .max = 1},
           "How much colour varies between individuals.");
}

float model_height(const SpeciesSettings& settings, int k) {
  const float along = (static_cast<float>(k) + 0.5F) / static_cast<float>(settings.models);
  return settings.height.low + along * (settings.height.high - settings.height.low);
}

namespace {

void check(std::span<const SpeciesSettings> settings) {
  for (std::size_t s = 0; s < settings.size(); ++s) {
    const std::string& name = settings[s].name;
    if (name.empty()) throw Error(ErrorKind::input, fmt::format("species {} has no name", s + 1));
    if (settings[s].plant.empty())
      throw Error(ErrorKind::input, fmt::format("species '{}' has no plant file", name));
    for (std::size_t other = 0; other < s; ++other)
      if (settings[other].name == name)
        throw Error(ErrorKind::input, fmt::format("two species are called '{}'", name));
  }
}

}  // namespace

std::vector<Species> grow_species(std::span<const SpeciesSettings> settings, std::uint64_t seed,
                                  Progress& progress) {
  check(settings);
  std::vector<Species> species;
  std::vector<std::pair<std::size_t, int>> jobs;
  for (std::size_t s = 0; s < settings.size(); ++s) {
    Species grown{settings[s], load_plant(settings[s].plant.path), {}};
    grown.models.resize(static_cast<std::size_t>(settings[s].models));
    species.push_back(std::move(grown));
    for (int k = 0; k < settings[s].models; ++k) jobs.emplace_back(s, k);
  }
  progress.begin("growing", static_cast<double>(jobs.size()), "models");
  parallel_for(0, static_cast<int>(jobs.size()), [&](int job) {
    const auto [s, k] = jobs[static_cast<std::size_t>(job)];
    Progress within;  // a model's own progress is not shown; cancelling waits for the model
    const GrowSettings grow_settings{.seed = random_bits(seed, hash_text(settings[s].name), k),
                                     .height = model_height(settings[s], k),
                                     .detail = settings[s].detail};
    species[s].models[static_cast<std::size_t>(k)] = grow(species[s].plant, grow_settings, within);
    progress.advance();
  });
  progress.end();
  return species;
}

}  // namespace wold
