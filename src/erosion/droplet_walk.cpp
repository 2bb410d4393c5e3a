#include "erosion/droplet_walk.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "noise/simd_targets.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "erosion/droplet_walk.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "erosion/droplet_lanes.hpp"

HWY_BEFORE_NAMESPACE();
namespace wold::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Floats = hn::CappedTag<float, droplet_group>;
using Ints = hn::RebindToSigned<Floats>;
using F = hn::Vec<Floats>;
using I = hn::Vec<Ints>;

HWY_INLINE F number(float x) {
  return hn::Set(Floats(), x);
}
HWY_INLINE F real(I x) {
  return hn::ConvertTo(Floats(), x);
}
/// The nearest integer of numbers below 2^22: what they add to 1.5 · 2^23 has no fraction.
constexpr float no_fraction = 0x1.8p23F;
HWY_INLINE I rounded(F x) {
  const Ints i;
  const F sum = hn::Add(x, number(no_fraction));
  return hn::Sub(hn::BitCast(i, sum), hn::BitCast(i, number(no_fraction)));
}
constexpr float largest_rounded = 0x1.fp21F;

// Four integers per drop lie together in blocks of 16 bytes, where drop 4 b + j of a vector has
// block b of the vector's j-th part: so that they are sorted into lanes, and back, within blocks.

/// Where the block of a drop of the group begins.
constexpr std::size_t slot_of(std::size_t drop) {
  constexpr std::size_t lanes = HWY_LANES(float) < droplet_group ? HWY_LANES(float) : droplet_group;
  return 4 * (drop / lanes * lanes) + drop % 4 * lanes + drop % lanes / 4 * 4;
}

struct Four {
  I a, b, c, d;
};

/// Both ways, as a transposition is.
HWY_INLINE Four transposed(const Four& v) {
  const Ints i;
  const hn::Repartition<std::int64_t, Ints> pairs;
  const auto low_ab = hn::BitCast(pairs, hn::InterleaveLower(i, v.a, v.b));
  const auto low_cd = hn::BitCast(pairs, hn::InterleaveLower(i, v.c, v.d));
  const auto high_ab = hn::BitCast(pairs, hn::InterleaveUpper(i, v.a, v.b));
  const auto high_cd = hn::BitCast(pairs, hn::InterleaveUpper(i, v.c, v.d));
  return {hn::BitCast(i, hn::InterleaveLower(pairs, low_ab, low_cd)),
          hn::BitCast(i, hn::InterleaveUpper(pairs, low_ab, low_cd)),
          hn::BitCast(i, hn::InterleaveLower(pairs, high_ab, high_cd)),
          hn::BitCast(i, hn::InterleaveUpper(pairs, high_ab, high_cd))};
}

HWY_INLINE Four load_blocks(const DropletBlocks& blocks, int k) {
  const Ints i;
  const std::int32_t* part = &blocks[4 * static_cast<std::size_t>(k)];
  const std::size_t n = hn::Lanes(i);
  return transposed({hn::Load(i, part), hn::Load(i, part + n), hn::Load(i, part + 2 * n),
                     hn::Load(i, part + 3 * n)});
}

HWY_INLINE void store_blocks(const Four& values, DropletBlocks& blocks, int k) {
  const Ints i;
  const Four v = transposed(values);
  std::int32_t* part = &blocks[4 * static_cast<std::size_t>(k)];
  const std::size_t n = hn::Lanes(i);
  hn::Store(v.a, i, part);
  hn::Store(v.b, i, part + n);
  hn::Store(v.c, i, part + 2 * n);
  hn::Store(v.d, i, part + 3 * n);
}

/// The ground at a place between four samples.
struct Ground {
  I height;  ///< quanta
  F gx, gy;  ///< quanta per cell
};

HWY_INLINE Ground ground_at(const DropletCorners& corners, int k, F fx, F fy) {
  const Four h = load_blocks(corners.heights, k);
  const F a = real(hn::Sub(h.b, h.a));
  const F c = real(hn::Sub(h.c, h.a));
  const F twist = hn::Sub(real(hn::Sub(h.d, h.c)), a);
  Ground g;
  g.gx = hn::MulAdd(fy, twist, a);
  g.gy = hn::MulAdd(fx, twist, c);
  g.height = hn::Add(h.a, hn::NearestInt(hn::MulAdd(fx, g.gx, hn::Mul(fy, c))));
  return g;
}

/// Quanta · cell² laid down (or taken up, negative) at the place before.
HWY_INLINE F exchange(const DropletRates& r, F fall, F came_down, F sediment, F v, F water) {
  const F zero = hn::Zero(Floats());
  const F most = number(0x1p29F);
  const F least = number(r.least_fall);
  F capacity = hn::Mul(hn::Mul(number(r.capacity), v), water);
  if (!r.momentum) capacity = hn::Mul(capacity, hn::Max(fall, least));
  capacity = hn::Min(capacity, most);
  const F surplus = hn::Sub(sediment, capacity);
  const F uphill = hn::Min(hn::Neg(fall), sediment);
  const F laid = hn::Min(hn::Mul(surplus, number(r.deposition)), hn::Max(came_down, least));
  const F taken = hn::Max(hn::Mul(surplus, number(r.erosion)), hn::Neg(fall));
  const F downhill = hn::IfThenElse(hn::Gt(surplus, zero), laid, taken);
  const F amount = hn::IfThenElse(hn::Lt(fall, zero), uphill, downhill);
  return hn::Max(hn::Min(amount, number(largest_rounded)), number(-largest_rounded));
}

/// Share of what is spread bilinearly at fraction f that is found when sampled d further.
HWY_INLINE F overlap(F f, F d) {
  const F one = number(1);
  const F zero = hn::Zero(Floats());
  const F t = hn::Add(f, d);
  const F low = hn::Max(zero, hn::Sub(one, hn::Abs(t)));
  const F high = hn::Max(zero, hn::Sub(one, hn::Abs(hn::Sub(t, one))));
  return hn::MulAdd(f, hn::Sub(high, low), low);
}

/// Splits an amount over the four samples around the place before, south-west first. Their sum,
/// truncated, is what the drop loses: never more than it has.
HWY_INLINE Four split(F amount, F fx, F fy, const DropletCorners& corners, int k, bool hardness) {
  const F y1 = hn::Mul(amount, fy);
  const F y0 = hn::Sub(amount, y1);
  F c10 = hn::Mul(y0, fx);
  F c00 = hn::Sub(y0, c10);
  F c11 = hn::Mul(y1, fx);
  F c01 = hn::Sub(y1, c11);
  if (hardness) {
    const Floats f;
    const auto taken = hn::Lt(amount, hn::Zero(f));
    const auto soften = [&](F c, const float* soft) {
      return hn::IfThenElse(taken, hn::Mul(c, hn::Load(f, soft + k)), c);
    };
    c00 = soften(c00, corners.soft00.data());
    c10 = soften(c10, corners.soft10.data());
    c01 = soften(c01, corners.soft01.data());
    c11 = soften(c11, corners.soft11.data());
  }
  return {rounded(hn::Trunc(c00)), rounded(hn::Trunc(c10)), rounded(hn::Trunc(c01)),
          rounded(hn::Trunc(c11))};
}

HWY_INLINE void store_changes(const Four& c, DropletChanges& changes, int k) {
  const I zero = hn::Zero(Ints());
  const auto wear = [&](I change) { return hn::Max(zero, hn::Sub(zero, change)); };
  store_blocks({c.a, wear(c.a), c.b, wear(c.b)}, changes.low, k);
  store_blocks({c.c, wear(c.c), c.d, wear(c.d)}, changes.high, k);
}

struct Motion {
  F dx, dy, v2;
};

/// The direction bends towards the fall line; the speed follows from the energy.
HWY_INLINE Motion bend(const DropletRates& r, const Ground& g, F dx, F dy, F v2, F fall,
                       hn::Mask<Floats> first) {
  const F zero = hn::Zero(Floats());
  const F keep = hn::IfThenZeroElse(first, number(r.keep));
  const F turn = number(r.turn);
  const F mx = hn::NegMulAdd(g.gx, turn, hn::Mul(dx, keep));
  const F my = hn::NegMulAdd(g.gy, turn, hn::Mul(dy, keep));
  const F norm2 = hn::MulAdd(mx, mx, hn::Mul(my, my));
  const auto turns = hn::Gt(norm2, number(1e-16F));
  const F scale = hn::Div(number(1), hn::Sqrt(hn::IfThenElse(turns, norm2, number(1))));
  const F accelerating = hn::IfThenElseZero(hn::Le(hn::Abs(fall), number(r.largest_fall)), fall);
  const F gained = hn::MulAdd(v2, number(r.drag), hn::Mul(accelerating, number(r.energy)));
  return {hn::IfThenElse(turns, hn::Mul(mx, scale), dx),
          hn::IfThenElse(turns, hn::Mul(my, scale), dy),
          hn::Min(hn::Max(gained, zero), number(r.highest_v2))};
}

/// The velocity is accelerated along each axis for the time that a cell takes,
/// 2 L / (v + sqrt(v² + 2 a L)).
HWY_INLINE Motion accelerate(const DropletRates& r, const Ground& g, F dx, F dy, F v2) {
  const F half = number(0.5F * r.energy);  // (m/s)² of a quantum: the acceleration times L
  const F limit = number(r.largest_fall);
  const F ax = hn::IfThenElseZero(hn::Le(hn::Abs(g.gx), limit), hn::Mul(hn::Neg(g.gx), half));
  const F ay = hn::IfThenElseZero(hn::Le(hn::Abs(g.gy), limit), hn::Mul(hn::Neg(g.gy), half));
  const F a = hn::Sqrt(hn::MulAdd(ax, ax, hn::Mul(ay, ay)));
  const F v = hn::Sqrt(v2);
  const F reach = hn::Sqrt(hn::MulAdd(a, number(2), v2));
  const F time = hn::Div(number(2), hn::Add(hn::Add(v, reach), number(1e-6F)));
  const F vx = hn::MulAdd(ax, time, hn::Mul(dx, v));
  const F vy = hn::MulAdd(ay, time, hn::Mul(dy, v));
  const F norm2 = hn::MulAdd(vx, vx, hn::Mul(vy, vy));
  const auto moves = hn::Gt(norm2, number(1e-12F));
  const F scale = hn::Div(number(1), hn::Sqrt(hn::IfThenElse(moves, norm2, number(1))));
  return {hn::IfThenElse(moves, hn::Mul(vx, scale), dx),
          hn::IfThenElse(moves, hn::Mul(vy, scale), dy),
          hn::Min(hn::Mul(norm2, number(r.drag)), number(r.highest_v2))};
}

/// Turns the direction by a random angle that belongs to the place: else drops would keep to the
/// rows and columns of samples, between which a ridge two samples wide feels flat.
HWY_INLINE void scatter(const DropletRates& r, F x, F y, Motion& m) {
  const Ints i;
  const auto product = [&](I v, std::uint32_t by) {
    return hn::Mul(v, hn::Set(i, static_cast<std::int32_t>(by)));
  };
  I bits =
      hn::Xor(product(hn::BitCast(i, x), 0x9e3779b1U), product(hn::BitCast(i, y), 0x85ebca77U));
  bits = product(hn::Xor(bits, hn::ShiftRight<15>(bits)), 0xc2b2ae3dU);
  const F n = hn::Mul(real(hn::ShiftRight<8>(bits)), number(r.scatter * 0x1p-23F));  // a tangent
  const F n2 = hn::Mul(n, n);
  const F scale = hn::MulAdd(n2, hn::MulAdd(n2, number(0.375F), number(-0.5F)), number(1));
  const F dx = hn::Mul(hn::NegMulAdd(n, m.dy, m.dx), scale);
  m.dy = hn::Mul(hn::MulAdd(n, m.dx, m.dy), scale);
  m.dx = dx;
}

HWY_INLINE std::uint32_t bits_of(hn::Mask<Floats> mask) {
  std::array<std::uint8_t, 8> bytes{};
  hn::StoreMaskBits(Floats(), mask, bytes.data());
  return bytes[0] | static_cast<std::uint32_t>(bytes[1]) << 8U;
}

/// The sample nearest to the drop, and its speed there.
HWY_INLINE void note_pass(const DropletLanes& l, int lane, F fx, F fy, F v2,
                          const DropletStep& step, DropletChanges& changes, int k) {
  const Ints i;
  const F half = number(0.5F);
  const auto beyond = [&](F fraction, int samples) {
    return hn::IfThenElseZero(hn::RebindMask(i, hn::Ge(fraction, half)), hn::Set(i, samples));
  };
  const I nearest =
      hn::Add(hn::Load(i, &l.at[lane]), hn::Add(beyond(fx, 1), beyond(fy, step.stride)));
  hn::Store(nearest, i, &changes.nearest[k]);
  hn::Store(rounded(hn::Mul(hn::Sqrt(v2), number(1 / droplet_speed_unit))), i, &changes.speed[k]);
}

/// One step of up to 16 lanes from `first`: fills `changes`, moves the drops, and returns which of
/// them have ended, as bits.
HWY_INLINE std::uint32_t step_vector(DropletLanes& l, int lane, const DropletCorners& corners,
                                     DropletChanges& changes, int k, const DropletStep& step) {
  const Floats f;
  const Ints i;
  const DropletRates& r = *step.rates;
  const F x = hn::Load(f, &l.x[lane]);
  const F y = hn::Load(f, &l.y[lane]);
  const F fx = hn::Sub(x, hn::Floor(x));
  const F fy = hn::Sub(y, hn::Floor(y));
  const F dx = hn::Load(f, &l.dx[lane]);
  const F dy = hn::Load(f, &l.dy[lane]);
  const F v2 = hn::Load(f, &l.v2[lane]);
  const F water = hn::Load(f, &l.water[lane]);
  const F left = hn::Load(f, &l.left[lane]);
  const F from_x = hn::Load(f, &l.from_x[lane]);
  const F from_y = hn::Load(f, &l.from_y[lane]);
  const I before = hn::Load(i, &l.height[lane]);
  const I sediment = hn::Load(i, &l.sediment[lane]);

  const Ground g = ground_at(corners, k, fx, fy);
  const I fall = hn::Sub(before, g.height);
  const F amount = exchange(r, real(fall), real(hn::Load(i, &l.came_down[lane])), real(sediment),
                            hn::Sqrt(v2), water);
  const Four c = split(amount, from_x, from_y, corners, k, step.hardness);
  store_changes(c, changes, k);
  const I change = hn::Add(hn::Add(c.a, c.b), hn::Add(c.c, c.d));
  const I carried = hn::Sub(sediment, change);
  hn::Store(carried, i, &l.sediment[lane]);
  const F found = hn::Mul(overlap(from_x, dx), overlap(from_y, dy));
  hn::Store(hn::Add(g.height, rounded(hn::Mul(real(change), found))), i, &l.height[lane]);
  const I zero = hn::Zero(i);
  hn::Store(hn::Max(zero, hn::Add(fall, hn::Min(change, zero))), i, &l.came_down[lane]);

  const auto first = hn::Eq(left, number(r.steps));
  Motion m = r.momentum ? accelerate(r, g, dx, dy, v2) : bend(r, g, dx, dy, v2, real(fall), first);
  scatter(r, x, y, m);
  hn::Store(m.dx, f, &l.dx[lane]);
  hn::Store(m.dy, f, &l.dy[lane]);
  hn::Store(m.v2, f, &l.v2[lane]);
  if (step.record) note_pass(l, lane, fx, fy, m.v2, step, changes, k);
  hn::Store(hn::IfThenElse(first, water, hn::Mul(water, number(r.water))), f, &l.water[lane]);
  const F now_left = hn::Sub(left, number(1));
  hn::Store(now_left, f, &l.left[lane]);
  hn::Store(fx, f, &l.from_x[lane]);
  hn::Store(fy, f, &l.from_y[lane]);
  hn::Store(hn::Load(i, &l.from[lane]), i, &changes.at[k]);
  hn::Store(hn::Load(i, &l.at[lane]), i, &l.from[lane]);

  const F to_x =
      hn::Min(hn::Max(hn::Add(x, m.dx), number(step.wall_left)), number(step.wall_right));
  const F to_y =
      hn::Min(hn::Max(hn::Add(y, m.dy), number(step.wall_bottom)), number(step.wall_top));
  hn::Store(to_x, f, &l.x[lane]);
  hn::Store(to_y, f, &l.y[lane]);
  const I at =
      hn::Add(hn::Mul(rounded(hn::Floor(to_y)), hn::Set(i, step.stride)), rounded(hn::Floor(to_x)));
  hn::Store(hn::Add(at, hn::Set(i, step.first)), i, &l.at[lane]);

  const F none = hn::Zero(f);
  const auto inside_x = hn::And(hn::Ge(to_x, none), hn::Lt(to_x, number(step.width)));
  const auto inside_y = hn::And(hn::Ge(to_y, none), hn::Lt(to_y, number(step.height)));
  const auto dried = hn::Le(now_left, none);
  const auto loaded = hn::Or(hn::RebindMask(f, hn::Gt(carried, zero)), first);
  const auto stands = hn::AndNot(loaded, hn::Lt(m.v2, number(1e-4F)));
  const auto goes_on = hn::AndNot(hn::Or(dried, stands), hn::And(inside_x, inside_y));
  return bits_of(hn::Not(goes_on));
}

std::uint32_t step_group(DropletLanes& lanes, int first, const DropletCorners& corners,
                         DropletChanges& changes, const DropletStep& step) {
  const int width = static_cast<int>(hn::Lanes(Floats()));
  std::uint32_t ended = 0;
  for (int k = 0; k < droplet_group; k += width)
    ended |= step_vector(lanes, first + k, corners, changes, k, step) << static_cast<unsigned>(k);
  return ended;
}

using Block = hn::FixedTag<std::int32_t, 4>;

/// Calls `work(k, slot)` for each drop of a group.
template <class Work>
HWY_INLINE void for_drops(int count, const Work& work) {
  if (count == droplet_group) {
    HWY_UNROLL(16)
    for (std::size_t k = 0; k < droplet_group; ++k) work(k, slot_of(k));
  } else {
    for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) work(k, slot_of(k));
  }
}

/// Reads the ground under the group from lane `first`.
void gather(const DropletWalk& walk, int first, DropletCorners& corners) {
  const Block block;
  const DropletCell* cells = walk.world().cells;
  const std::ptrdiff_t stride = walk.world().stride;
  const std::int32_t* at = &walk.lanes.at[static_cast<std::size_t>(first)];
  const int count = std::min(droplet_group, walk.active() - first);
  for_drops(count, [&](std::size_t k, std::size_t slot) HWY_ATTR {
    const auto* low = reinterpret_cast<const std::int32_t*>(cells + at[k]);
    const auto* high = reinterpret_cast<const std::int32_t*>(cells + at[k] + stride);
    const auto heights = hn::ConcatEven(block, hn::LoadU(block, high), hn::LoadU(block, low));
    hn::Store(heights, block, &corners.heights[slot]);
  });
  if (walk.step().hardness) walk.gather_softness(first, count, corners);
}

void apply_changes(const DropletWorld& world, int count, const DropletChanges& changes) {
  const Block block;
  const std::ptrdiff_t stride = world.stride;
  for_drops(count, [&](std::size_t k, std::size_t slot) HWY_ATTR {
    auto* low = reinterpret_cast<std::int32_t*>(world.cells + changes.at[k]);
    auto* high = reinterpret_cast<std::int32_t*>(world.cells + changes.at[k] + stride);
    hn::StoreU(hn::Add(hn::LoadU(block, low), hn::Load(block, &changes.low[slot])), block, low);
    hn::StoreU(hn::Add(hn::LoadU(block, high), hn::Load(block, &changes.high[slot])), block, high);
  });
}

/// In the order of lanes, for what is done to single drops.
DropletChanges sorted(const DropletChanges& changes) {
  DropletChanges out = changes;
  for (std::size_t k = 0; k < droplet_group; ++k)
    for (std::size_t n = 0; n < 4; ++n) {
      out.low[4 * k + n] = changes.low[slot_of(k) + n];
      out.high[4 * k + n] = changes.high[slot_of(k) + n];
    }
  return out;
}

void record(const DropletWorld& world, int count, const DropletChanges& changes) {
  for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) {
    DropletPasses& here = world.passes[changes.nearest[k]];
    ++here.count;
    here.speed += static_cast<std::uint32_t>(changes.speed[k]);
  }
}

void walk_lanes(DropletWalk& walk, DropletTally& tally, const Progress& progress) {
  std::array<DropletCorners, 2> corners{};  // the next group is read while one is worked on
  DropletChanges changes;
  while (walk.active() > 0) {
    progress.check();
    tally.steps += walk.active();
    gather(walk, 0, corners[0]);
    int turn = 0;
    for (int first = 0; first < walk.active(); first += droplet_group) {
      const int count = std::min(droplet_group, walk.active() - first);
      const DropletCorners& here = corners[turn];
      turn ^= 1;
      if (first + droplet_group < walk.active()) gather(walk, first + droplet_group, corners[turn]);
      std::uint32_t ended = step_group(walk.lanes, first, here, changes, walk.step());
      apply_changes(walk.world(), count, changes);
      if (walk.step().record) record(walk.world(), count, changes);
      if (walk.world().colors != nullptr) walk.carry_colors(first, count, sorted(changes));
      ended &= (std::uint32_t{1} << static_cast<unsigned>(count)) - 1U;
      if (ended != 0) walk.end_lanes(first, ended);
    }
  }
}

}  // namespace
}  // namespace wold::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace wold {

HWY_EXPORT(walk_lanes);

void walk_droplets(const DropletWorld& world, const DropletRates& rates,
                   const DropletRegion& region, const std::vector<Drop>& drops, DropletTally& tally,
                   const Progress& progress) {
  DropletWalk walk(world, rates, region, drops, tally);
  HWY_DYNAMIC_DISPATCH(walk_lanes)(walk, tally, progress);
}

}  // namespace wold
#endif
