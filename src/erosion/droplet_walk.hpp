#pragma once
// The steps of drops inside one tile (droplets.hpp): the hot loop.

#include <bit>
#include <cstdint>
#include <vector>

#include "base/progress.hpp"
#include "base/vec.hpp"

namespace wold {

/// One sample of the ground. Heights are integers: quanta above `DropletGround::base`. A drop
/// changes both by the addition of one number of 64 bits, which needs the wear in its lower half.
struct DropletCell {
  std::int32_t wear = 0;  ///< quanta taken up so far
  std::int32_t height = 0;
};
static_assert(std::endian::native == std::endian::little);

/// What is left of a direction at least: so it is never zero.
constexpr float droplet_least_keep = 1e-6F;

/// The constants of a step, in quanta and cells.
struct DropletRates {
  bool momentum = false;
  float steps = 0;         ///< in a life
  float keep = 0;          ///< of the direction, e^(-L/ℓ)
  float turn = 0;          ///< (1 - keep) per quantum of height over a cell
  float scatter = 0;       ///< tangent of the largest random turn
  float capacity = 0;      ///< per quantum of fall and m/s (momentum: per m/s)
  float least_fall = 0;    ///< quanta per step
  float erosion = 0;       ///< of what is missing, per step
  float deposition = 0;    ///< of the surplus, per step
  float water = 1;         ///< what evaporation leaves per step
  float energy = 0;        ///< gain of v² per quantum of fall, (m/s)²
  float drag = 1;          ///< what drag leaves of v² per step
  float highest_v2 = 0;    ///< (m/s)²
  float largest_fall = 0;  ///< quanta per step that still accelerate
};

/// A drop between two tiles, or at its start.
struct Drop {
  IVec2 cell{0};        ///< its place: sample to the south-west …
  Vec2 fraction{0};     ///< … and what is beyond it, cells
  Vec2 from{0};         ///< the fraction of the place before
  std::int32_t at = 0;  ///< the sample south-west of the place before, as an index
  Vec2 direction{0};
  float v = 0;                 ///< m/s
  float water = 1;             ///< share left
  float left = 0;              ///< steps
  std::int32_t sediment = 0;   ///< quanta · cell²
  std::int32_t height = 0;     ///< of the place before
  std::int32_t came_down = 0;  ///< quanta to the place before
  Vec3 color{0};
};

/// Colours of the ground's skin, and of what lies beneath.
struct DropletColors {
  std::vector<Vec3> skin;
  std::vector<Vec3> beneath;
  float depth = 0;  ///< quanta
};

/// Drops that passed nearest to a sample.
struct DropletPasses {
  std::uint32_t count = 0;
  std::uint32_t speed = 0;  ///< their sum, droplet_speed_unit m/s
};

/// What the walks of all tiles share. Pointers to arrays of stride · height; null for none.
struct DropletWorld {
  int width = 0;
  int height = 0;
  int stride = 0;  ///< from row to row, `droplet_stride(width)`
  DropletCell* cells = nullptr;
  const float* softness = nullptr;  ///< 0 to 1, share of the erosion
  DropletPasses* passes = nullptr;  ///< while recorded
  DropletColors* colors = nullptr;
  bool closed_border = false;
};

/// Rows an odd number of cache lines apart: with rows of a power of two, samples above each other
/// would compete for the same few lines of each cache.
constexpr int droplet_stride(int width) {
  constexpr int line = 64 / static_cast<int>(sizeof(DropletCell));
  return line * ((width + line - 1) / line | 1);
}

constexpr float droplet_speed_unit = 1.0F / 64;

/// The samples that a walk may touch.
struct DropletRegion {
  int left = 0, bottom = 0, right = 0, top = 0;  ///< right and top not included
};

/// What became of a tile's drops.
struct DropletTally {
  std::vector<Drop> leaving;  ///< into other tiles
  std::int64_t removed = 0;   ///< quanta · cell² over the border
  std::int64_t finished = 0;  ///< drops
  std::int64_t steps = 0;
  Vec3 color_removed{0};  ///< colour · quanta
};

/// Moves the drops until each has ended or left the region.
void walk_droplets(const DropletWorld& world, const DropletRates& rates,
                   const DropletRegion& region, const std::vector<Drop>& drops, DropletTally& tally,
                   const Progress& progress);

}  // namespace wold
