// One step of drops by the equations of droplets.hpp, for droplet_walk.cpp. Included once per
// target of Highway, after foreach_target.h.

#if defined(WOLD_DROPLET_STEP_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef WOLD_DROPLET_STEP_INL
#undef WOLD_DROPLET_STEP_INL
#else
#define WOLD_DROPLET_STEP_INL
#endif

#include "erosion/droplet_vectors-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace wold::HWY_NAMESPACE {
namespace {

/// The ground at a place between four samples.
struct Ground {
  I height;  ///< quanta
  F gx, gy;  ///< quanta per cell
};

HWY_INLINE Ground ground_at(const DropletCorners& corners, int k, F fx, F fy) {
  const Four h = load_blocks(corners.heights, k);
  const F a = real(h.b - h.a);
  const F c = real(h.c - h.a);
  const F twist = real(h.d - h.c) - a;
  Ground g;
  g.gx = mul_add(fy, twist, a);
  g.gy = mul_add(fx, twist, c);
  g.height = h.a + nearest(mul_add(fx, g.gx, fy * c));
  return g;
}

/// Quanta · cell² laid down (or taken up, negative) at the place before.
HWY_INLINE F exchange(const DropletRates& r, F fall, F came_down, F sediment, F v, F water) {
  const F zero = number(0);
  const F most = number(0x1p29F);
  const F least = number(r.least_fall);
  F capacity = number(r.capacity) * v * water;
  if (!r.momentum) capacity = capacity * max(fall, least);
  capacity = min(capacity, most);
  const F surplus = sediment - capacity;
  const F uphill = min(-fall, sediment);
  const F laid = min(surplus * number(r.deposition), max(came_down, least));
  const F taken = max(surplus * number(r.erosion), -fall);
  const F downhill = choose(surplus > zero, laid, taken);
  return choose(fall < zero, uphill, downhill);
}

/// Share of what is spread bilinearly at fraction f that is found when sampled d further.
HWY_INLINE F overlap(F f, F d) {
  const F one = number(1);
  const F zero = number(0);
  const F t = f + d;
  const F low = max(zero, one - abs(t));
  const F high = max(zero, one - abs(t - one));
  return mul_add(f, high - low, low);
}

/// Splits an amount over the four samples around the place before, south-west first. Their sum,
/// truncated, is what the drop loses: never more than it has.
HWY_INLINE Four split(F amount, F fx, F fy, const DropletCorners& corners, int k, bool hardness) {
  const F y1 = amount * fy;
  const F y0 = amount - y1;
  F c10 = y0 * fx;
  F c00 = y0 - c10;
  F c11 = y1 * fx;
  F c01 = y1 - c11;
  if (hardness) {
    const FMask taken = amount < number(0);
    const auto soften = [&](F c, const auto& soft)
                            HWY_ATTR { return choose(taken, c * load(soft.data() + k), c); };
    c00 = soften(c00, corners.soft00);
    c10 = soften(c10, corners.soft10);
    c01 = soften(c01, corners.soft01);
    c11 = soften(c11, corners.soft11);
  }
  return {truncated(c00), truncated(c10), truncated(c01), truncated(c11)};
}

HWY_INLINE void store_change(I change, DropletWords& words, int k) {
  const I zero = whole(0);
  store_words(max(zero, zero - change), change, words, k);
}

/// Where a drop wants to go, and how fast it then is.
struct Motion {
  F x, y;  ///< of any length
  F v2;
};

/// The direction bends towards the fall line; the speed follows from the energy.
HWY_INLINE Motion bend(const DropletRates& r, const Ground& g, F dx, F dy, F v, F fall,
                       FMask first) {
  const F keep = choose(first, number(droplet_least_keep), number(r.keep));
  const F turn = number(r.turn);
  const F accelerating = only(abs(fall) <= number(r.largest_fall), fall);
  const F gained = mul_add(v * v, number(r.drag), accelerating * number(r.energy));
  return {neg_mul_add(g.gx, turn, dx * keep), neg_mul_add(g.gy, turn, dy * keep),
          min(max(gained, number(0)), number(r.highest_v2))};
}

/// The velocity is accelerated along each axis for the time that a cell takes,
/// 2 L / (v + sqrt(v² + 2 a L)).
HWY_INLINE Motion accelerate(const DropletRates& r, const Ground& g, F dx, F dy, F v) {
  const F half = number(-0.5F * r.energy);  // (m/s)² of a quantum: the acceleration times -L
  const F limit = number(r.largest_fall);
  const F ax = only(abs(g.gx) <= limit, g.gx * half);
  const F ay = only(abs(g.gy) <= limit, g.gy * half);
  const F a = sqrt(mul_add(ax, ax, ay * ay));
  const F reach = sqrt(mul_add(a, number(2), v * v));
  const F still = number(1e-6F);  // then it keeps its direction
  const F time = number(2) / (v + reach + still);
  const F vx = mul_add(ax, time, dx * (v + still));
  const F vy = mul_add(ay, time, dy * (v + still));
  const F v2 = mul_add(vx, vx, vy * vy);
  return {vx, vy, min(v2 * number(r.drag), number(r.highest_v2))};
}

/// Turns the direction by a random angle that belongs to the place: else drops would keep to the
/// rows and columns of samples, between which a ridge two samples wide feels flat.
HWY_INLINE void scatter(const DropletRates& r, F x, F y, Motion& m) {
  const auto factor = [](std::uint32_t by)
                          HWY_ATTR { return whole(static_cast<std::int32_t>(by)); };
  I bits = bits_of(x) * factor(0x9e3779b1U) ^ bits_of(y) * factor(0x85ebca77U);
  bits = (bits ^ shift_right<15>(bits)) * factor(0xc2b2ae3dU);
  const F n = real(shift_right<8>(bits)) * number(r.scatter * 0x1p-23F);  // a tangent
  const F turned = neg_mul_add(n, m.y, m.x);
  m.y = mul_add(n, m.x, m.y);
  m.x = turned;
}

/// The sample nearest to the drop, and its speed there.
HWY_INLINE void note_pass(const DropletLanes& l, int lane, F fx, F fy, F v, const DropletStep& step,
                          DropletChanges& changes, int k) {
  const F half = number(0.5F);
  const I east = only(for_ints(fx >= half), whole(1));
  const I north = only(for_ints(fy >= half), whole(step.stride));
  store(load(&l.at[lane]) + east + north, &changes.nearest[k]);
  store(nearest(v * number(1 / droplet_speed_unit)), &changes.speed[k]);
}

/// What drops do to the ground at the place before, in `changes`, and to what they carry. Returns
/// which carry nothing.
HWY_INLINE FMask erode(DropletLanes& l, int lane, const DropletCorners& corners, const Ground& g,
                       I fall, DropletChanges& changes, int k, const DropletStep& step) {
  const F from_x = load(&l.from_x[lane]);
  const F from_y = load(&l.from_y[lane]);
  const I sediment = load(&l.sediment[lane]);
  const F amount = exchange(*step.rates, real(fall), real(load(&l.came_down[lane])), real(sediment),
                            load(&l.v[lane]), load(&l.water[lane]));
  const Four c = split(amount, from_x, from_y, corners, k, step.hardness);
  store_change(c.a, changes.corners[0], k);
  store_change(c.b, changes.corners[1], k);
  store_change(c.c, changes.corners[2], k);
  store_change(c.d, changes.corners[3], k);
  const I change = c.a + c.b + (c.c + c.d);
  const I carried = sediment - change;
  store(carried, &l.sediment[lane]);
  const F found = overlap(from_x, load(&l.dx[lane])) * overlap(from_y, load(&l.dy[lane]));
  store(g.height + nearest(real(change) * found), &l.height[lane]);
  const I zero = whole(0);
  store(max(zero, fall + min(change, zero)), &l.came_down[lane]);
  return !positive(carried);
}

/// One step of the drops of two vectors from `lane`: fills `changes`, moves them, and returns which
/// have ended, as bits.
HWY_INLINE std::uint32_t step_vectors(DropletLanes& l, int lane, const DropletCorners& corners,
                                      DropletChanges& changes, int k, const DropletStep& step) {
  const DropletRates& r = *step.rates;
  const F x = load(&l.x[lane]);
  const F y = load(&l.y[lane]);
  const F fx = x - floor(x);
  const F fy = y - floor(y);
  const F dx = load(&l.dx[lane]);
  const F dy = load(&l.dy[lane]);
  const F v = load(&l.v[lane]);
  const F left = load(&l.left[lane]);
  const FMask first = left == number(r.steps);

  const Ground g = ground_at(corners, k, fx, fy);
  const I fall = load(&l.height[lane]) - g.height;
  Motion m = r.momentum ? accelerate(r, g, dx, dy, v) : bend(r, g, dx, dy, v, real(fall), first);
  scatter(r, x, y, m);
  const F norm2 = max(mul_add(m.x, m.x, m.y * m.y), number(1e-30F));
  const F scale = number(1) / sqrt(norm2);
  const F to_dx = m.x * scale;
  const F to_dy = m.y * scale;
  const F to_v = sqrt(m.v2);
  const FMask empty = erode(l, lane, corners, g, fall, changes, k, step);
  store(to_dx, &l.dx[lane]);
  store(to_dy, &l.dy[lane]);
  store(to_v, &l.v[lane]);
  if (step.record) note_pass(l, lane, fx, fy, to_v, step, changes, k);
  store(load(&l.water[lane]) * number(r.water), &l.water[lane]);
  const F now_left = left - number(1);
  store(now_left, &l.left[lane]);
  store(fx, &l.from_x[lane]);
  store(fy, &l.from_y[lane]);
  store(load(&l.from[lane]), &changes.at[k]);
  store(load(&l.at[lane]), &l.from[lane]);

  const F to_x = min(max(x + to_dx, number(step.wall_left)), number(step.wall_right));
  const F to_y = min(max(y + to_dy, number(step.wall_bottom)), number(step.wall_top));
  store(to_x, &l.x[lane]);
  store(to_y, &l.y[lane]);
  store(truncated(floor(to_y)) * whole(step.stride) + truncated(floor(to_x)) + whole(step.first),
        &l.at[lane]);

  const F zero = number(0);
  const FMask outside = !((to_x >= zero) & (to_x < number(step.width)) & (to_y >= zero) &
                          (to_y < number(step.height)));
  const FMask dried = now_left <= zero;
  const FMask stands = (m.v2 < number(1e-4F)) & empty & !first;
  return bits_of(dried | stands | outside);
}

}  // namespace
}  // namespace wold::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
