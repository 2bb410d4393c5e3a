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
HWY_INLINE I truncated(F x) {
  return hn::ConvertTo(Ints(), x);
}

/// The ground at a place between four samples.
struct Ground {
  I height;  ///< quanta
  F gx, gy;  ///< quanta per cell
};

HWY_INLINE Ground ground_at(const DropletCorners& corners, int k, F fx, F fy) {
  const Ints i;
  const I h00 = hn::Load(i, &corners.h00[k]);
  const I h10 = hn::Load(i, &corners.h10[k]);
  const I h01 = hn::Load(i, &corners.h01[k]);
  const I h11 = hn::Load(i, &corners.h11[k]);
  const F a = real(hn::Sub(h10, h00));
  const F c = real(hn::Sub(h01, h00));
  const F twist = hn::Sub(real(hn::Sub(h11, h01)), a);
  Ground g;
  g.gx = hn::MulAdd(fy, twist, a);
  g.gy = hn::MulAdd(fx, twist, c);
  g.height = hn::Add(h00, hn::NearestInt(hn::MulAdd(fx, g.gx, hn::Mul(fy, c))));
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
  return hn::IfThenElse(hn::Lt(fall, zero), uphill, downhill);
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

struct Corner4 {
  I c00, c10, c01, c11;
};

/// Splits an amount over the four samples around the place before; what truncation leaves stays
/// with the drop.
HWY_INLINE Corner4 split(F amount, F fx, F fy, const DropletCorners& corners, int k,
                         bool hardness) {
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
  return {truncated(c00), truncated(c10), truncated(c01), truncated(c11)};
}

HWY_INLINE void store_changes(const Corner4& c, DropletChanges& changes, int k) {
  const Ints i;
  const I zero = hn::Zero(i);
  const auto wear = [&](I change) { return hn::Max(zero, hn::Sub(zero, change)); };
  hn::StoreInterleaved4(c.c00, wear(c.c00), c.c10, wear(c.c10), i, &changes.low[4 * k]);
  hn::StoreInterleaved4(c.c01, wear(c.c01), c.c11, wear(c.c11), i, &changes.high[4 * k]);
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

HWY_INLINE std::uint32_t bits_of(hn::Mask<Floats> mask) {
  std::array<std::uint8_t, 8> bytes{};
  hn::StoreMaskBits(Floats(), mask, bytes.data());
  return bytes[0] | static_cast<std::uint32_t>(bytes[1]) << 8U;
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
  const Corner4 c = split(amount, from_x, from_y, corners, k, step.hardness);
  store_changes(c, changes, k);
  const I change = hn::Add(hn::Add(c.c00, c.c10), hn::Add(c.c01, c.c11));
  const I carried = hn::Sub(sediment, change);
  hn::Store(carried, i, &l.sediment[lane]);
  const F found = hn::Mul(overlap(from_x, dx), overlap(from_y, dy));
  hn::Store(hn::Add(g.height, hn::NearestInt(hn::Mul(real(change), found))), i, &l.height[lane]);
  const I zero = hn::Zero(i);
  hn::Store(hn::Max(zero, hn::Add(fall, hn::Min(change, zero))), i, &l.came_down[lane]);

  const auto first = hn::Eq(left, number(r.steps));
  const Motion m =
      r.momentum ? accelerate(r, g, dx, dy, v2) : bend(r, g, dx, dy, v2, real(fall), first);
  hn::Store(m.dx, f, &l.dx[lane]);
  hn::Store(m.dy, f, &l.dy[lane]);
  hn::Store(m.v2, f, &l.v2[lane]);
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
  const I at = hn::Add(hn::Mul(truncated(to_y), hn::Set(i, step.stride)), truncated(to_x));
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

void apply_changes(const DropletWorld& world, int count, const DropletChanges& changes) {
  const hn::FixedTag<std::int32_t, 4> pair;
  for (int k = 0; k < count; ++k) {
    auto* low = reinterpret_cast<std::int32_t*>(world.cells + changes.at[k]);
    auto* high = reinterpret_cast<std::int32_t*>(world.cells + changes.at[k] + world.width);
    hn::StoreU(hn::Add(hn::LoadU(pair, low), hn::Load(pair, &changes.low[4 * k])), pair, low);
    hn::StoreU(hn::Add(hn::LoadU(pair, high), hn::Load(pair, &changes.high[4 * k])), pair, high);
  }
}

void walk_lanes(DropletWalk& walk, DropletTally& tally, const Progress& progress) {
  std::array<DropletCorners, 2> corners{};  // the next group is read while one is worked on
  DropletChanges changes;
  while (walk.active() > 0) {
    progress.check();
    tally.steps += walk.active();
    walk.gather(0, corners[0]);
    int turn = 0;
    for (int first = 0; first < walk.active(); first += droplet_group) {
      const int count = std::min(droplet_group, walk.active() - first);
      const DropletCorners& here = corners[turn];
      turn ^= 1;
      if (first + droplet_group < walk.active()) walk.gather(first + droplet_group, corners[turn]);
      std::uint32_t ended = step_group(walk.lanes, first, here, changes, walk.step());
      apply_changes(walk.world(), count, changes);
      walk.follow(first, count, changes);
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
