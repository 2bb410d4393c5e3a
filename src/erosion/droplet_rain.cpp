#include "erosion/droplet_rain.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "base/hash.hpp"
#include "base/parallel.hpp"

namespace wold {

namespace {

constexpr double drops_of_tile = 256;
constexpr int least_side = 32;
constexpr int largest_side = 256;

enum class Purpose : std::uint8_t { shift_x, shift_y, place, direction, share };

}  // namespace

std::vector<DropletShower> droplet_showers(double density, int count, std::uint64_t seed) {
  std::vector<DropletShower> showers;
  const double spacing = std::sqrt(count / density);
  for (int k = 0; k < count; ++k) {
    const DVec2 shift(uniform_double(random_bits(seed, Purpose::shift_x, k)),
                      uniform_double(random_bits(seed, Purpose::shift_y, k)));
    showers.push_back({spacing, spacing * shift, random_bits(seed, Purpose::place, k)});
  }
  return showers;
}

int droplet_tile_side(double drops_per_shower_and_cell) {
  int side = least_side;
  while (side < largest_side && side * side * drops_per_shower_and_cell < drops_of_tile) side *= 2;
  return side;
}

DropletTiles::DropletTiles(const Heightfield& input, int side, const Grid<float>* share)
    : origin_(input.origin),
      cell_(input.cell),
      width_(input.height.width()),
      height_(input.height.height()),
      side_(side),
      columns_((width_ + side - 1) / side),
      share_(share) {
  const int rows = (height_ + side - 1) / side;
  const int margin = side / 2;  // tiles of one colour lie `side` apart
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns_; ++i) {
      by_color_[static_cast<std::size_t>(j) % 2 * 2 + static_cast<std::size_t>(i) % 2].push_back(
          static_cast<int>(tiles_.size()));
      Tile tile;
      tile.place = {i, j};
      tile.region = {std::max(0, i * side - margin), std::max(0, j * side - margin),
                     std::min(width_, (i + 1) * side + margin),
                     std::min(height_, (j + 1) * side + margin)};
      tiles_.push_back(std::move(tile));
    }
}

void DropletTiles::rain(const DropletShower& shower, float life) {
  parallel_for(0, static_cast<int>(tiles_.size()),
               [&](int t) { rain_on(tiles_[static_cast<std::size_t>(t)], shower, life); });
}

void DropletTiles::rain_on(Tile& tile, const DropletShower& shower, float life) const {
  const DVec2 low = origin_ + cell_ * side_ * DVec2(tile.place) - shower.shift;
  const DVec2 high = low + DVec2(cell_ * side_);
  const auto lattice = [&](double x) { return static_cast<int>(std::floor(x / shower.spacing)); };
  for (int j = lattice(low.y); j <= lattice(high.y); ++j)
    for (int i = lattice(low.x); i <= lattice(high.x); ++i) {
      const std::uint64_t bits = random_bits(shower.seed, i, j);
      const DVec2 jitter(uniform_double(bits), uniform_double(mix_bits(bits)));
      const DVec2 place =
          (shower.spacing * (DVec2(i, j) + jitter) + shower.shift - origin_) / cell_;
      if (!(place.x >= 0 && place.y >= 0 && place.x < width_ - 1 && place.y < height_ - 1))
        continue;
      const IVec2 cell(place);
      if (cell / side_ != tile.place) continue;
      if (share_ != nullptr && !(uniform(random_bits(bits, Purpose::share)) <
                                 (*share_)(cell.x + (place.x - cell.x >= 0.5 ? 1 : 0),
                                           cell.y + (place.y - cell.y >= 0.5 ? 1 : 0))))
        continue;
      const float angle = 2 * pi * uniform(random_bits(bits, Purpose::direction));
      Drop drop;
      drop.cell = cell;
      drop.fraction = Vec2(place - DVec2(cell));
      drop.direction = {std::cos(angle), std::sin(angle)};
      drop.left = life;
      tile.waiting.push_back(drop);
    }
}

void DropletTiles::move(const DropletWorld& world, const DropletRates& rates, int first,
                        Progress& progress) {
  for (int turn = 0; turn < 4; ++turn) {
    std::vector<Tile*> color;
    for (const int t : by_color_[(first + turn) % 4])
      if (Tile& tile = tiles_[static_cast<std::size_t>(t)]; !tile.waiting.empty())
        color.push_back(&tile);
    // The fullest first, each by whoever is free: then threads end together.
    std::stable_sort(color.begin(), color.end(), [](const Tile* a, const Tile* b) {
      return a->waiting.size() > b->waiting.size();
    });
    std::atomic<std::size_t> next = 0;
    parallel_for(0, static_cast<int>(color.size()), [&](int) {
      for (std::size_t k = next++; k < color.size(); k = next++) {
        Tile& tile = *color[k];
        walk_droplets(world, rates, tile.region, tile.waiting, tile.tally, progress);
        tile.waiting.clear();
        progress.advance(static_cast<double>(tile.tally.finished));
      }
    });
    hand_over();
  }
}

void DropletTiles::hand_over() {
  for (Tile& tile : tiles_) {
    for (const Drop& drop : tile.tally.leaving) {
      const IVec2 place = drop.cell / side_;
      tiles_[static_cast<std::size_t>(place.y) * static_cast<std::size_t>(columns_) +
             static_cast<std::size_t>(place.x)]
          .waiting.push_back(drop);
    }
    removed += tile.tally.removed;
    steps += tile.tally.steps;
    color_removed += tile.tally.color_removed;
    tile.tally.leaving.clear();
    tile.tally.removed = tile.tally.steps = tile.tally.finished = 0;
    tile.tally.color_removed = Vec3(0);
  }
}

bool DropletTiles::empty() const {
  return std::all_of(tiles_.begin(), tiles_.end(),
                     [](const Tile& tile) { return tile.waiting.empty(); });
}

}  // namespace wold
