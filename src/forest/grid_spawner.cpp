#include "forest/grid_spawner.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/error.hpp"
#include "base/hash.hpp"
#include "forest/species_mix.hpp"

namespace wold {

namespace {

enum class Draw { spawn, species, model, x, y, yaw, scale, individual };

std::size_t choose(std::span<const double> share, double u) {
  std::size_t chosen = 0;
  for (std::size_t k = 0; k < share.size(); ++k) {
    if (share[k] > 0) chosen = k;
    u -= share[k];
    if (u < 0) break;
  }
  return chosen;
}

}  // namespace

Description<GridSpawner> describe(const GridSpawner&) {
  return Description<GridSpawner>("grid", "A grid of plants, or a single one at a place.")
      .choice("around", &GridSpawner::around, {"camera", "world"},
              "What the offset is counted from.")
      .add("species", &GridSpawner::species, {.min = 0},
           "Names of species and how often each is chosen; empty: all alike.")
      .add("cells", &GridSpawner::cells, {.min = 1, .max = 100000},
           "Number of cells eastwards and northwards.")
      .add("cell_size", &GridSpawner::cell_size, {.unit = "m", .min = 0, .max = 10000},
           "Side of a cell.")
      .add("offset", &GridSpawner::offset, {.unit = "m", .min = -1e6, .max = 1e6},
           "To the middle of the grid, east and north.")
      .add("probability", &GridSpawner::probability, {.min = 0, .max = 1},
           "Chance of a cell to get a plant.")
      .add("position_spread", &GridSpawner::position_spread, {.min = 0, .max = 1},
           "Share of the cell in which the plant may stand.")
      .add("scale", &GridSpawner::scale, {.min = 0.001, .max = 1000},
           "Size of plants against their models.");
}

std::vector<Instance> spawn_grid(const Heightfield& ground, const GridSpawner& spawner,
                                 std::span<const SpeciesSettings> species, DVec2 centre,
                                 std::uint64_t seed) {
  const std::vector<double> share = species_shares(spawner.species, species, "grid");
  constexpr std::int64_t most_cells = 100'000'000;
  const std::int64_t count = static_cast<std::int64_t>(spawner.cells.x) * spawner.cells.y;
  if (count > most_cells)
    throw Error(ErrorKind::limit,
                fmt::format("'cells' in 'grid' are {} altogether; at most {} can be filled", count,
                            most_cells));
  std::vector<Instance> plants;
  if (species.empty()) return plants;
  const auto cell = static_cast<double>(spawner.cell_size);
  const DVec2 corner =
      centre + DVec2(spawner.offset) - 0.5 * cell * DVec2(spawner.cells.x, spawner.cells.y);
  for (int j = 0; j < spawner.cells.y; ++j)
    for (int i = 0; i < spawner.cells.x; ++i) {
      const std::uint64_t key = random_bits(seed, i, j);
      const auto draw = [&](Draw what) { return uniform(random_bits(key, what)); };
      if (draw(Draw::spawn) >= spawner.probability) continue;
      const Vec2 within = spawner.position_spread * (Vec2(draw(Draw::x), draw(Draw::y)) - 0.5F);
      const DVec2 place = corner + cell * (DVec2(i, j) + DVec2(0.5) + DVec2(within));
      if (!ground.contains(place)) continue;
      Instance plant;
      const std::size_t kind = choose(share, static_cast<double>(draw(Draw::species)));
      plant.species = static_cast<std::uint16_t>(kind);
      plant.model =
          static_cast<std::uint16_t>(draw(Draw::model) * static_cast<float>(species[kind].models));
      plant.individual = static_cast<std::uint32_t>(random_bits(key, Draw::individual));
      plant.yaw = 2 * pi * draw(Draw::yaw);
      plant.scale =
          spawner.scale.low + draw(Draw::scale) * (spawner.scale.high - spawner.scale.low);
      plant.position = {static_cast<float>(place.x), static_cast<float>(place.y),
                        ground_at(ground, place).height};
      plants.push_back(plant);
    }
  return plants;
}

}  // namespace wold
