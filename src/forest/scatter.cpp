#include "forest/scatter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "base/error.hpp"
#include "base/hash.hpp"
#include "base/memory.hpp"
#include "base/parallel.hpp"
#include "forest/disc_field.hpp"
#include "forest/species_mix.hpp"
#include "noise/noise.hpp"

namespace wold {

namespace {

/// What a random number of a candidate is for.
enum class Draw { count, x, y, kind, thin, yaw, scale, lean, lean_towards, model, individual };

constexpr double candidates_per_cell = 8;
constexpr double candidates_per_tile = 12000;

struct Candidate {
  DVec2 place{0};
  std::uint64_t key = 0;   ///< random, of this candidate alone
  std::uint64_t rank = 0;  ///< size class, then random
  std::uint32_t sequence = 0;
  std::uint16_t kind = 0;
  GroundSample ground;
};

float draw(std::uint64_t key, Draw what) {
  return uniform(random_bits(key, what));
}

/// A Poisson-distributed number, by inversion.
int poisson(double mean, double u) {
  double probability = std::exp(-mean);
  double sum = probability;
  int n = 0;
  while (u >= sum && n < 1000) {
    ++n;
    probability *= mean / n;
    sum += probability;
  }
  return n;
}

struct CellRange {
  int low_i, low_j, high_i, high_j;  // [low, high)
};

/// Everything that is the same for all tiles.
class Scatterer {
 public:
  Scatterer(const Heightfield& ground, const ScatterSettings& settings,
            std::span<const SpeciesSettings> species, const ScatterPlace& place, std::uint64_t seed)
      : settings_(settings),
        species_(species),
        place_(place),
        seed_(seed),
        plan_(plan_scatter(settings, species)),
        map_(scatter_suitability(ground, settings, place, seed)) {
    if (!(plan_.candidates > 0)) return;
    for (const SpeciesSettings& s : species)
      patch_seed_.push_back(static_cast<std::uint32_t>(random_bits(seed, hash_text(s.name))));
    cell_ = std::sqrt(candidates_per_cell / plan_.candidates);
    margin_ = 8 * static_cast<double>(plan_.class_radius[0]);
    tile_ = static_cast<int>(std::max(std::sqrt(candidates_per_tile / candidates_per_cell),
                                      std::ceil(2 * margin_ / cell_)));
    set_window(ground);
  }

  bool empty() const { return columns_ <= 0 || rows_ <= 0; }
  int tiles() const { return empty() ? 0 : columns_ * rows_; }
  void check_memory() const;
  std::vector<Instance> fill_tile(int tile) const;

 private:
  void set_window(const Heightfield& ground);
  std::vector<Candidate> candidates_in(const CellRange& cells) const;
  std::uint16_t choose_kind(DVec2 place, float u) const;
  /// Those of the tile that stay; false when the margin was too small to tell.
  bool resolve(std::vector<Candidate>& candidates, const CellRange& tile, DVec2 low,
               DVec2 high) const;
  bool in_tile(DVec2 place, const CellRange& tile) const;
  Instance planted(const Candidate& candidate) const;

  const ScatterSettings& settings_;
  std::span<const SpeciesSettings> species_;
  ScatterPlace place_;
  std::uint64_t seed_;
  SpacingPlan plan_;
  SuitabilityMap map_;
  std::vector<std::uint32_t> patch_seed_;  // of each species
  DVec2 low_{0};                           // window within the ground
  DVec2 high_{0};
  double cell_ = 1;       // m
  double margin_ = 1;     // m
  int tile_ = 1;          // cells
  int first_column_ = 0;  // tiles
  int first_row_ = 0;
  int columns_ = 0;
  int rows_ = 0;
};

void Scatterer::set_window(const Heightfield& ground) {
  // The ground includes its far border, the window does not.
  const DVec2 ground_high = ground.origin + ground.size();
  const DVec2 beyond{std::nextafter(ground_high.x, 1e300), std::nextafter(ground_high.y, 1e300)};
  low_ = glm::max(place_.low, ground.origin);
  high_ = glm::min(place_.high, beyond);
  if (settings_.where.within > 0) {
    const DVec2 reach(static_cast<double>(settings_.where.within));
    low_ = glm::max(low_, place_.centre - reach);
    high_ = glm::min(high_, place_.centre + reach);
  }
  if (!(low_.x < high_.x && low_.y < high_.y)) return;
  const double side = cell_ * tile_;
  if (std::max(glm::length(low_), glm::length(high_)) / cell_ > 1e9)
    throw Error(ErrorKind::limit,
                fmt::format("plants at {} per m² are too dense to be told apart {} m "
                            "from the origin",
                            settings_.density, glm::length(high_)));
  first_column_ = static_cast<int>(std::floor(low_.x / side));
  first_row_ = static_cast<int>(std::floor(low_.y / side));
  columns_ = static_cast<int>(std::floor(high_.x / side)) - first_column_ + 1;
  rows_ = static_cast<int>(std::floor(high_.y / side)) - first_row_ + 1;
}

void Scatterer::check_memory() const {
  const DVec2 size = high_ - low_;
  const double plants = plan_.reached() * size.x * size.y;
  const double bytes = 2 * plants * sizeof(Instance);  // by tile, then joined
  const auto free = static_cast<double>(available_memory());
  constexpr double most_plants = 2e9;
  if (plants > most_plants || (free > 0 && bytes > 0.9 * free))
    throw Error(
        ErrorKind::limit,
        fmt::format("scattering would set up to {:.0f} plants, which takes {}; {} are free. "
                    "Lower 'density' or give 'within'",
                    plants, memory_text(bytes), memory_text(free)));
}

std::uint16_t Scatterer::choose_kind(DVec2 place, float u) const {
  constexpr float contrast = 5;
  const bool patches = settings_.patchiness > 0 && plan_.kinds.size() > 1;
  std::array<float, 64> weight{};
  const std::size_t count = std::min(plan_.kinds.size(), weight.size());
  float sum = 0;
  for (std::size_t k = 0; k < count; ++k) {
    weight[k] = static_cast<float>(plan_.kinds[k].candidates);
    if (patches && weight[k] > 0) {
      const DVec2 p = place / static_cast<double>(settings_.patch_size);
      const float noise = gradient_noise(p, patch_seed_[k]).value;
      weight[k] *= std::exp(contrast * settings_.patchiness * noise);
    }
    sum += weight[k];
  }
  float rest = u * sum;
  std::size_t chosen = 0;
  for (std::size_t k = 0; k < count; ++k) {
    if (weight[k] > 0) chosen = k;
    rest -= weight[k];
    if (rest < 0) break;
  }
  return static_cast<std::uint16_t>(chosen);
}

std::vector<Candidate> Scatterer::candidates_in(const CellRange& cells) const {
  std::vector<Candidate> candidates;
  for (int j = cells.low_j; j < cells.high_j; ++j)
    for (int i = cells.low_i; i < cells.high_i; ++i) {
      const DVec2 corner = cell_ * DVec2(i, j);
      if (map_.barren(corner, corner + DVec2(cell_))) continue;
      const std::uint64_t cell_key = random_bits(seed_, i, j);
      const int count =
          poisson(candidates_per_cell, uniform_double(random_bits(cell_key, Draw::count)));
      for (int n = 0; n < count; ++n) {
        Candidate c;
        c.key = random_bits(cell_key, n);
        c.place = corner + cell_ * DVec2(uniform_double(random_bits(c.key, Draw::x)),
                                         uniform_double(random_bits(c.key, Draw::y)));
        const Suitability suits = map_.at(c.place);
        if (!(suits.part > 0)) continue;
        c.kind = choose_kind(c.place, draw(c.key, Draw::kind));
        const DiscKind& kind = plan_.kinds[c.kind];
        if (static_cast<double>(draw(c.key, Draw::thin)) >=
            kind.share_for(static_cast<double>(suits.part)))
          continue;
        c.ground = suits.ground;
        c.rank = (static_cast<std::uint64_t>(kind.size_class) << 58U) | (mix_bits(c.key) >> 6U);
        c.sequence = static_cast<std::uint32_t>(candidates.size());
        candidates.push_back(c);
      }
    }
  return candidates;
}

bool Scatterer::in_tile(DVec2 p, const CellRange& tile) const {
  return p.x >= low_.x && p.y >= low_.y && p.x < high_.x && p.y < high_.y &&
         p.x >= cell_ * tile.low_i && p.y >= cell_ * tile.low_j && p.x < cell_ * tile.high_i &&
         p.y < cell_ * tile.high_j;
}

bool Scatterer::resolve(std::vector<Candidate>& candidates, const CellRange& tile, DVec2 low,
                        DVec2 high) const {
  std::sort(candidates.begin(), candidates.end(),
            [](const Candidate& a, const Candidate& b) { return a.rank < b.rank; });
  DiscField field(low, high, plan_.class_radius);
  std::vector<Candidate> kept;
  for (const Candidate& c : candidates) {
    const DiscKind& kind = plan_.kinds[c.kind];
    DiscFit fit = field.test(c.place, kind.radius, kind.size_class);
    if (fit == DiscFit::taken) continue;
    const double reach =
        static_cast<double>(kind.radius) + static_cast<double>(plan_.class_radius[0]);
    const double to_border =
        std::min({c.place.x - low.x, c.place.y - low.y, high.x - c.place.x, high.y - c.place.y});
    const bool certain = fit == DiscFit::free && to_border >= reach;
    field.add(c.place, kind.radius, kind.size_class, certain);
    if (!in_tile(c.place, tile)) continue;
    if (!certain) return false;
    kept.push_back(c);
  }
  std::sort(kept.begin(), kept.end(),
            [](const Candidate& a, const Candidate& b) { return a.sequence < b.sequence; });
  candidates = std::move(kept);
  return true;
}

Instance Scatterer::planted(const Candidate& c) const {
  const SpeciesSettings& species = species_[c.kind];
  Instance plant;
  plant.species = c.kind;
  plant.model =
      static_cast<std::uint16_t>(draw(c.key, Draw::model) * static_cast<float>(species.models));
  plant.individual = static_cast<std::uint32_t>(random_bits(c.key, Draw::individual));
  plant.yaw = 2 * pi * draw(c.key, Draw::yaw);
  const Range scale = settings_.scale;
  plant.scale = scale.low + draw(c.key, Draw::scale) * (scale.high - scale.low);

  const Vec3 leaning = glm::mix(Vec3(0, 0, 1), normal_of(c.ground.gradient), settings_.align);
  const float lean = std::tan(radians(settings_.tilt)) * std::sqrt(draw(c.key, Draw::lean));
  const float towards = 2 * pi * draw(c.key, Draw::lean_towards);
  plant.up = glm::normalize(leaning + lean * Vec3(std::cos(towards), std::sin(towards), 0));

  // On a slope the downhill side of an upright stem would hang in the air.
  constexpr float stem_radius = 0.02F;  // of the height
  const float height = 0.5F * (species.height.low + species.height.high) * plant.scale;
  const float steepness = std::min(glm::length(c.ground.gradient), 2.0F);
  const float sink = settings_.sink + (1 - settings_.align) * stem_radius * height * steepness;
  plant.position = {static_cast<float>(c.place.x), static_cast<float>(c.place.y),
                    c.ground.height - sink};
  return plant;
}

std::vector<Instance> Scatterer::fill_tile(int tile) const {
  const int column = first_column_ + tile % columns_;
  const int row = first_row_ + tile / columns_;
  const CellRange inner{column * tile_, row * tile_, (column + 1) * tile_, (row + 1) * tile_};
  if (map_.barren(cell_ * DVec2(inner.low_i, inner.low_j),
                  cell_ * DVec2(inner.high_i, inner.high_j)))
    return {};
  constexpr int most_tries = 8;
  for (int attempt = 0; attempt < most_tries; ++attempt) {
    const int around = static_cast<int>(std::ceil(std::ldexp(margin_, attempt) / cell_));
    const CellRange outer{inner.low_i - around, inner.low_j - around, inner.high_i + around,
                          inner.high_j + around};
    std::vector<Candidate> candidates = candidates_in(outer);
    if (!resolve(candidates, inner, cell_ * DVec2(outer.low_i, outer.low_j),
                 cell_ * DVec2(outer.high_i, outer.high_j)))
      continue;
    std::vector<Instance> plants;
    plants.reserve(candidates.size());
    for (const Candidate& c : candidates) plants.push_back(planted(c));
    return plants;
  }
  throw Error(ErrorKind::internal, "a tile of plants depends on places too far away");
}

}  // namespace

Description<ScatterSettings> describe(const ScatterSettings&) {
  using S = ScatterSettings;
  return Description<S>("scatter", "Plants spread evenly or in clumps where the land suits them.")
      .add("species", &S::species, {.min = 0},
           "Names of species and how often each is chosen; empty: all alike.")
      .add("density", &S::density, {.unit = "per m²", .min = 0, .max = 10000},
           "Plants per square metre where all suits.")
      .add("evenness", &S::evenness, {.min = 0, .max = 0.9},
           "Distance plants keep, as a share of the most their density allows; 0: at random.")
      .add("patchiness", &S::patchiness, {.min = 0, .max = 1},
           "How much each species keeps to its own groups.")
      .add("patch_size", &S::patch_size, {.unit = "m", .min = 0.01, .max = 100000},
           "From group to group.")
      .include(&S::where)
      .add("mask", &S::mask,
           "A map that a terrain step makes, or a picture over the whole terrain: 1 or white full "
           "density.")
      .add("scale", &S::scale, {.min = 0.001, .max = 1000}, "Size of plants against their models.")
      .add("align", &S::align, {.min = 0, .max = 1},
           "0: stems upright; 1: at right angles to the ground.")
      .add("tilt", &S::tilt, {.unit = "degrees", .min = 0, .max = 60}, "Random lean, at most.")
      .add("sink", &S::sink, {.unit = "m", .min = -10, .max = 10},
           "How deep the foot is set into the ground.");
}

SpacingPlan plan_scatter(const ScatterSettings& settings,
                         std::span<const SpeciesSettings> species) {
  constexpr std::size_t most_species = 64;
  if (species.size() > most_species)
    throw Error(ErrorKind::limit, fmt::format("{} species; {} at most can be scattered",
                                              species.size(), most_species));
  std::vector<double> density = species_shares(settings.species, species, "scatter");
  for (double& d : density) d *= settings.density;
  if (density.empty() || !(*std::max_element(density.begin(), density.end()) > 0)) return {};
  const double apart = static_cast<double>(settings.evenness) * jamming_distance(settings.density);
  std::vector<float> radius;
  for (const SpeciesSettings& s : species)
    radius.push_back(std::max({s.exclusion_radius(), static_cast<float>(0.5 * apart), 1e-3F}));
  return plan_spacing(radius, density);
}

SuitabilityMap scatter_suitability(const Heightfield& ground, const ScatterSettings& settings,
                                   const ScatterPlace& place, std::uint64_t seed) {
  return {settings.where, ground, place.mask, place.centre, random_bits(seed, 1)};
}

std::vector<Instance> scatter(const Heightfield& ground, const ScatterSettings& settings,
                              std::span<const SpeciesSettings> species, const ScatterPlace& place,
                              std::uint64_t seed, Progress& progress) {
  const Scatterer scatterer(ground, settings, species, place, seed);
  if (scatterer.empty()) return {};
  scatterer.check_memory();
  const int tiles = scatterer.tiles();
  progress.begin("scattering", tiles, "tiles");
  std::vector<std::vector<Instance>> by_tile(static_cast<std::size_t>(tiles));
  parallel_for(0, tiles, [&](int tile) {
    by_tile[static_cast<std::size_t>(tile)] = scatterer.fill_tile(tile);
    progress.advance();
  });
  std::size_t count = 0;
  for (const auto& plants : by_tile) count += plants.size();
  std::vector<Instance> all;
  all.reserve(count);
  for (auto& plants : by_tile) {
    all.insert(all.end(), plants.begin(), plants.end());
    std::vector<Instance>().swap(plants);
  }
  progress.end();
  return all;
}

}  // namespace wold
