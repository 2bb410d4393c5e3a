#include "erosion/droplet_walk.hpp"

#include <algorithm>
#include <array>
#include <cstring>

#include "noise/simd_targets.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "erosion/droplet_walk.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "erosion/droplet_lanes.hpp"
#include "erosion/droplet_step-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace wold::HWY_NAMESPACE {
namespace {

HWY_NOINLINE std::uint32_t step_group(DropletLanes& lanes, int first, const DropletCorners& corners,
                                      DropletChanges& changes, const DropletStep& step) {
  std::uint32_t ended = 0;
  for (int k = 0; k < droplet_group; k += 2 * vector_drops)
    ended |= step_vectors(lanes, first + k, corners, changes, k, step) << static_cast<unsigned>(k);
  return ended;
}

/// Calls `work(k)` for each drop of a group.
template <class Work>
HWY_INLINE void for_drops(int count, const Work& work) {
  if (count == droplet_group) {
    HWY_UNROLL(32)
    for (std::size_t k = 0; k < droplet_group; ++k) work(k);
  } else {
    for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) work(k);
  }
}

/// Reads the ground under the group from lane `first`.
HWY_NOINLINE void gather(const DropletWalk& walk, int first, DropletCorners& corners) {
  const hn::FixedTag<std::int32_t, 4> block;
  const DropletCell* cells = walk.world().cells;
  const std::ptrdiff_t stride = walk.world().stride;
  const std::int32_t* at = &walk.lanes.at[static_cast<std::size_t>(first)];
  const int count = std::min(droplet_group, walk.active() - first);
  for_drops(count, [&](std::size_t k) HWY_ATTR {
    const auto* low = reinterpret_cast<const std::int32_t*>(cells + at[k]);
    const auto* high = reinterpret_cast<const std::int32_t*>(cells + at[k] + stride);
    const auto heights = hn::ConcatOdd(block, hn::LoadU(block, high), hn::LoadU(block, low));
    hn::Store(heights, block, &corners.heights[block_of(k)]);
  });
  if (walk.step().hardness) walk.gather_softness(first, count, corners);
}

HWY_INLINE void add_word(std::uint64_t word, void* to) {
  std::uint64_t sum;
  std::memcpy(&sum, to, sizeof sum);
  sum += word;
  std::memcpy(to, &sum, sizeof sum);
}

HWY_NOINLINE void apply_changes(const DropletWorld& world, int count,
                                const DropletChanges& changes) {
  const std::ptrdiff_t stride = world.stride;
  DropletCell* cells = world.cells;
  for_drops(count, [&](std::size_t k) {
    DropletCell* low = cells + changes.at[k];
    DropletCell* high = low + stride;
    add_word(changes.corners[0][word_of(k)], low);
    add_word(changes.corners[1][word_of(k)], low + 1);
    add_word(changes.corners[2][word_of(k)], high);
    add_word(changes.corners[3][word_of(k)], high + 1);
  });
}

HWY_NOINLINE void record(const DropletWorld& world, int count, const DropletChanges& changes) {
  DropletPasses* passes = world.passes;
  for_drops(count, [&](std::size_t k) {
    const auto speed = static_cast<std::uint32_t>(changes.speed[k]);
    add_word(1 | static_cast<std::uint64_t>(speed) << 32U, passes + changes.nearest[k]);
  });
}

void carry_colors(DropletWalk& walk, int first, int count, const DropletChanges& changes) {
  for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) {
    std::array<std::int32_t, 4> heights{};
    for (std::size_t n = 0; n < 4; ++n)
      heights[n] = static_cast<std::int32_t>(changes.corners[n][word_of(k)] >> 32U);
    walk.carry_colors(static_cast<std::size_t>(first) + k, changes.at[k], heights);
  }
}

void walk_lanes(DropletWalk& walk, DropletTally& tally, const Progress& progress) {
  std::array<DropletCorners, 2> corners{};  // the next group is read while one is worked on
  DropletChanges changes;
  int turn = 0;
  int first = 0;
  gather(walk, first, corners[0]);
  while (walk.active() > 0) {
    const int count = std::min(droplet_group, walk.active() - first);
    int next = first + droplet_group < walk.active() ? first + droplet_group : 0;
    const bool ahead = next != first;
    if (ahead) gather(walk, next, corners[turn ^ 1]);
    tally.steps += count;
    std::uint32_t ended = step_group(walk.lanes, first, corners[turn], changes, walk.step());
    apply_changes(walk.world(), count, changes);
    if (walk.step().record) record(walk.world(), count, changes);
    if (walk.world().colors != nullptr) carry_colors(walk, first, count, changes);
    ended &= ~std::uint32_t{0} >> static_cast<unsigned>(droplet_group - count);
    if (ended != 0) walk.end_lanes(first, ended);
    turn ^= 1;
    if (!ahead || next >= walk.active()) gather(walk, next = 0, corners[turn]);
    first = next;
    if (first == 0) progress.check();
  }
}

}  // namespace
}  // namespace wold::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace wold {

HWY_EXPORT(walk_lanes);

namespace {

constexpr std::size_t droplet_fetched = 128;  // so many drops come to most of the ground

/// Brings the ground into the second cache in order: in the order of drops it would take longer.
void fetch(const DropletWorld& world, const DropletRegion& region) {
  constexpr int line = 64 / static_cast<int>(sizeof(DropletCell));
  for (int j = region.bottom; j < region.top; ++j) {
    const DropletCell* row = world.cells + static_cast<std::ptrdiff_t>(j) * world.stride;
    for (int i = region.left; i < region.right; i += line) hwy::Prefetch(row + i);
  }
}

}  // namespace

void walk_droplets(const DropletWorld& world, const DropletRates& rates,
                   const DropletRegion& region, const std::vector<Drop>& drops, DropletTally& tally,
                   const Progress& progress) {
  if (drops.size() >= droplet_fetched) fetch(world, region);
  DropletWalk walk(world, rates, region, drops, tally);
  HWY_DYNAMIC_DISPATCH(walk_lanes)(walk, tally, progress);
}

}  // namespace wold
#endif
