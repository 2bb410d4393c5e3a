#include "erosion/droplet_rates.hpp"

#include <algorithm>
#include <cmath>

namespace wold {

DropletRates droplet_rates(const Droplets& p, double cell, double quantum) {
  const auto length = static_cast<float>(cell);
  const auto q = static_cast<float>(quantum);
  DropletRates r;
  r.momentum = p.variant == DropletVariant::momentum;
  r.steps = 1 + std::max(1.0F, std::round(p.distance / length));  // the first looks around
  r.keep = std::max(p.inertia > 0 ? std::exp(-length / p.inertia) : 0, droplet_least_keep);
  r.turn = (1 - r.keep) * q / length;
  r.scatter = std::tan(radians(p.scatter));
  r.capacity = p.capacity / (length * length * (r.momentum ? q : length));
  r.least_fall = p.min_slope * length / q;
  r.erosion = -std::expm1(-p.erosion * length);
  r.deposition = -std::expm1(-p.deposition * length);
  r.water = std::exp(-p.evaporation * length);
  r.energy = 2 * p.gravity * q;
  r.drag = std::exp(-2 * p.drag * length);
  r.highest_v2 = p.max_speed * p.max_speed;
  r.largest_fall = p.max_drop / q;
  return r;
}

}  // namespace wold
