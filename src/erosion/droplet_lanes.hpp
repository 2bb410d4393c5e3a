#pragma once
// The drops that a walk has under way, as arrays over lanes, and what is done to single lanes.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "erosion/droplet_walk.hpp"

namespace wold {

constexpr int droplet_group = 32;  ///< drops that step together, whatever a vector holds
constexpr int droplet_lanes = 64;  ///< under way at once: their ground stays in the first cache

template <class T>
using LaneArray = std::array<T, droplet_lanes>;

/// Places are in cells from the region's first sample.
struct DropletLanes {
  alignas(64) LaneArray<float> x, y;
  alignas(64) LaneArray<float> from_x, from_y;  ///< fractions of the place before
  alignas(64) LaneArray<float> dx, dy;
  alignas(64) LaneArray<float> v, water, left;
  alignas(64) LaneArray<std::int32_t> sediment, height, came_down;
  alignas(64) LaneArray<std::int32_t> at, from;  ///< samples to the south-west, as indices
  LaneArray<Vec3> color;
};

/// Four integers for each drop of a group, in an order that suits vectors.
using DropletBlocks = std::array<std::int32_t, static_cast<std::size_t>(4 * droplet_group)>;

/// The ground under a group: heights now, softness at the place before.
struct DropletCorners {
  alignas(64) DropletBlocks heights;
  alignas(64) std::array<float, droplet_group> soft00, soft10, soft01, soft11;
};

/// What is added to a cell for each drop of a group, as one number: wear, and height above it.
using DropletWords = std::array<std::uint64_t, droplet_group>;

/// What a group does to the ground: at the sample to the south-west, east and north of it, and
/// both.
struct DropletChanges {
  alignas(64) std::array<DropletWords, 4> corners;
  alignas(64) std::array<std::int32_t, droplet_group> at;              ///< sample to the south-west
  alignas(64) std::array<std::int32_t, droplet_group> nearest, speed;  ///< while recorded
};

/// Where a step may lead.
struct DropletStep {
  const DropletRates* rates = nullptr;
  float width = 0, height = 0;  ///< places lie below these, cells
  float wall_left, wall_right, wall_bottom, wall_top;
  int stride = 0;
  int first = 0;  ///< index of the region's first sample
  bool hardness = false;
  bool record = false;
};

class DropletWalk {
 public:
  DropletWalk(const DropletWorld& world, const DropletRates& rates, const DropletRegion& region,
              const std::vector<Drop>& drops, DropletTally& tally);

  /// Ends the lanes of a group whose bits are set and fills them with waiting drops.
  void end_lanes(int first, std::uint32_t ended);

  void gather_softness(int first, int count, DropletCorners& corners) const;
  /// Moves the colours of what a drop took up or laid down around sample `at`: heights of the four.
  void carry_colors(std::size_t lane, std::int32_t at, const std::array<std::int32_t, 4>& change);

  int active() const { return active_; }
  const DropletWorld& world() const { return world_; }
  const DropletStep& step() const { return step_; }

  DropletLanes lanes;

 private:
  void begin_lane(std::size_t lane, const Drop& drop);
  void end_lane(std::size_t lane);
  void lay_down(std::size_t lane);
  void leave(std::size_t lane);
  void move_lane(std::size_t to, std::size_t from);
  std::int32_t height_at(std::size_t lane) const;

  const DropletWorld& world_;
  const DropletRegion& region_;
  const std::vector<Drop>& drops_;
  DropletTally& tally_;
  DropletStep step_;
  std::size_t next_ = 0;  ///< drop to start
  int active_ = 0;
};

}  // namespace wold
