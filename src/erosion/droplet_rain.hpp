#pragma once
// Where drops start, and the tiles that move them (droplets.hpp).

#include <cstdint>
#include <vector>

#include "base/grid.hpp"
#include "erosion/droplet_walk.hpp"
#include "terrain/operator.hpp"

namespace wold {

/// One drop in each cell of a lattice in the world, at a random place in it.
struct DropletShower {
  double spacing = 0;  ///< m, of the lattice
  DVec2 shift{0};      ///< m
  std::uint64_t seed = 0;
};

/// Rain of `density` drops per m² in `count` showers.
std::vector<DropletShower> droplet_showers(double density, int count, std::uint64_t seed);

/// The ground cut into squares, each with the drops that wait there.
class DropletTiles {
 public:
  /// `side` in cells; `share`, 0 to 1, is how many of the drops fall, or null for all.
  DropletTiles(const Heightfield& input, int side, const Grid<float>* share);

  /// Lets it rain. `life`: steps.
  void rain(const DropletShower& shower, float life);
  /// Moves drops: each colour of tiles once, beginning with colour `first`.
  void move(const DropletWorld& world, const DropletRates& rates, int first, Progress& progress);
  bool empty() const;

  std::int64_t removed = 0;  ///< quanta · cell² over the border
  std::int64_t steps = 0;
  Vec3 color_removed{0};

 private:
  struct Tile {
    IVec2 place{0};
    DropletRegion region;
    std::vector<Drop> waiting;
    DropletTally tally;
  };

  void rain_on(Tile& tile, const DropletShower& shower, float life) const;
  void hand_over();

  DVec2 origin_{0};
  double cell_ = 1;
  int width_ = 0;
  int height_ = 0;
  int side_ = 0;
  int columns_ = 0;
  const Grid<float>* share_ = nullptr;
  std::vector<Tile> tiles_;
  std::vector<int> by_color_[4];
};

/// The side of tiles for such a rain per shower: enough drops in each for full vectors.
int droplet_tile_side(double drops_per_shower_and_cell);

}  // namespace wold
