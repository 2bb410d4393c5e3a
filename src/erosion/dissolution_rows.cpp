#include "erosion/dissolution_rows.hpp"

namespace wold::dissolution_detail {

using pipes_detail::grains_per_metre;
using pipes_detail::metres_per_grain;

namespace {

constexpr float diagonal = 1.41421356F;

float higher(float a, float b) {
  return a > b ? a : b;
}
float lower(float a, float b) {
  return a < b ? a : b;
}

float metres(Grains grains) {
  return metres_per_grain * static_cast<float>(grains);
}

float drop(const GroundRow& a, int i, const GroundRow& b, int k) {
  return (a.ground[i] - b.ground[k]) + metres(a.change[i] - b.change[k]);
}

/// What is spread from sample k of b to sample i of a, where that is downhill.
Grains spread(const GroundRow& a, int i, const GroundRow& b, int k) {
  const Grains from_b = (a.taken[i] - b.taken[k]) / 8;
  const Grains down = from_b < 0 ? from_b : 0;
  const Grains up = from_b > 0 ? from_b : 0;
  return drop(a, i, b, k) > 0 ? down : up;
}

/// How far the surface falls from a to b, at least 0, m.
float fall(const WaterRow& a, int i, const WaterRow& b, int k) {
  const Grains grains = (a.change[i] - b.change[k]) + (a.depth[i] - b.depth[k]);
  return higher((a.ground[i] - b.ground[k]) + metres_per_grain * static_cast<float>(grains), 0);
}

Grains water_out(float give, float drop) {
  return static_cast<Grains>(give * drop);
}

Grains with_it(Grains water, float load) {
  return static_cast<Grains>(static_cast<float>(water) * load);
}

}  // namespace

Sums& Sums::operator+=(const Sums& b) {
  water_in += b.water_in;
  water_out += b.water_out;
  ground_out += b.ground_out;
  taken_up += b.taken_up;
  return *this;
}

Sums weather(const WeatherRow& row, int n, const WeatherConstants& constants) {
  const WeatherRow r = row;  // copies, which nothing written below can change
  const WeatherConstants c = constants;
  Grains* __restrict depth = r.depth;
  Grains* __restrict dissolved = r.dissolved;
  Grains* __restrict taken = r.taken;
  Sums sums;
  for (int i = 0; i < n; ++i) {
    const auto in = static_cast<Grains>(r.rain[i] * c.rain + c.turn);
    const Grains wet = depth[i] + in;
    const auto gone = static_cast<Grains>(static_cast<float>(wet) * c.evaporated);
    const Grains left = wet > gone ? wet - gone : 0;
    const bool dries = left < c.dry;
    const Grains held = dries ? 0 : left;
    const float deepest = higher(higher(drop(r.at, i, r.at, i - 1), drop(r.at, i, r.at, i + 1)),
                                 higher(drop(r.at, i, r.below, i), drop(r.at, i, r.above, i)));
    const float most = 0.5F * grains_per_metre * higher(deepest + c.least_drop, 0);
    const float lack = c.saturation * static_cast<float>(held) - static_cast<float>(dissolved[i]);
    const float up = lower(higher(lack, 0) * c.dissolving * r.ease[i], most);
    const float down = lower(lack, 0) * c.depositing;
    const auto exchanged = static_cast<Grains>(up + down);
    // What dries up lays down all it held.
    const Grains x = dries ? -dissolved[i] : exchanged;
    depth[i] = held;
    dissolved[i] += x;
    taken[i] = x;
    sums.water_in += in;
    sums.water_out += wet - held;
    sums.taken_up += x > 0 ? x : 0;
  }
  return sums;
}

void wear(const GroundRow& row_below, const GroundRow& row, const GroundRow& row_above,
          Grains* __restrict change, int n) {
  const GroundRow below = row_below;
  const GroundRow at = row;
  const GroundRow above = row_above;
  for (int i = 0; i < n; ++i)
    change[i] = at.change[i] - at.taken[i] +
                ((spread(at, i, at, i - 1) + spread(at, i, at, i + 1)) +
                 (spread(at, i, below, i) + spread(at, i, above, i)));
}

Flow flow_between(const WaterRow& a, int i, const WaterRow& b, int k, float distance) {
  const float drop = fall(a, i, b, k) * (distance > 1 ? 1 / diagonal : 1.0F);
  const Grains water = water_out(a.give[i], drop);
  return {water, with_it(water, a.load[i])};
}

void offer(const WaterRow& below, const WaterRow& at, const WaterRow& above, float* __restrict give,
           float* __restrict load, int n) {
  for (int i = 0; i < n; ++i) {
    const float w = fall(at, i, at, i - 1);
    const float e = fall(at, i, at, i + 1);
    const float s = fall(at, i, below, i);
    const float m = fall(at, i, above, i);
    const float sw = fall(at, i, below, i - 1);
    const float se = fall(at, i, below, i + 1);
    const float nw = fall(at, i, above, i - 1);
    const float ne = fall(at, i, above, i + 1);
    const float beside = (w + e) + (s + m);
    const float across = (sw + ne) + (se + nw);
    const float count = ((w > 0 ? 1.0F : 0.0F) + (e > 0 ? 1.0F : 0.0F)) +
                        ((s > 0 ? 1.0F : 0.0F) + (m > 0 ? 1.0F : 0.0F)) +
                        ((sw > 0 ? 1.0F : 0.0F) + (ne > 0 ? 1.0F : 0.0F)) +
                        ((se > 0 ? 1.0F : 0.0F) + (nw > 0 ? 1.0F : 0.0F));
    const auto held = static_cast<float>(at.depth[i]);
    const float above_mean = (beside + across) / (count + 1) * grains_per_metre;
    const float moved = lower(0.99999F * held, 0.5F * above_mean);
    const float shares = beside + across / diagonal;
    give[i] = moved / higher(shares, 1e-9F);
    load[i] = static_cast<float>(at.dissolved[i]) / higher(held, 1);
  }
}

void flow(const WaterRow& below, const WaterRow& at, const WaterRow& above,
          Grains* __restrict depth, Grains* __restrict dissolved, int n) {
  for (int i = 0; i < n; ++i) {
    Grains water = at.depth[i];
    Grains ground = at.dissolved[i];
    const auto exchange = [&](const WaterRow& b, int k, float per_cell) {
      const float drop_out = fall(at, i, b, k) * per_cell;
      const float drop_in = fall(b, k, at, i) * per_cell;
      const Grains out = water_out(at.give[i], drop_out);
      const Grains in = water_out(b.give[k], drop_in);
      water += in - out;
      ground += with_it(in, b.load[k]) - with_it(out, at.load[i]);
    };
    exchange(at, i - 1, 1);
    exchange(at, i + 1, 1);
    exchange(below, i, 1);
    exchange(above, i, 1);
    exchange(below, i - 1, 1 / diagonal);
    exchange(below, i + 1, 1 / diagonal);
    exchange(above, i - 1, 1 / diagonal);
    exchange(above, i + 1, 1 / diagonal);
    depth[i] = water;
    dissolved[i] = ground;
  }
}

}  // namespace wold::dissolution_detail
