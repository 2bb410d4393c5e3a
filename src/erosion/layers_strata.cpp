#include "erosion/layers_strata.hpp"

#include <fmt/format.h>

#include <cmath>

namespace wold::layers_detail {

namespace {

void check_list(const std::vector<double>& list, const char* name, double low, double high,
                std::size_t count) {
  if (list.size() != count)
    throw Error(ErrorKind::input,
                fmt::format("'{}' needs one number for each 'thickness', which has {}; it has {}",
                            name, count, list.size()));
  for (const double v : list)
    if (!(v >= low && v <= high))
      throw Error(ErrorKind::input,
                  fmt::format("'{}' may hold {:g} to {:g}, not {:g}", name, low, high, v));
}

}  // namespace

Stack::Stack(const Layers& p) {
  const std::size_t count = p.thickness.size();
  if (count == 0 || count > 100)
    throw Error(ErrorKind::input,
                fmt::format("'thickness' needs 1 to 100 layers; it has {}", count));
  check_list(p.thickness, "thickness", 0.1, 1e4, count);
  check_list(p.layer_hardness, "layer_hardness", 0, 1, count);
  check_list(p.layer_angle, "layer_angle", 1, 89, count);
  check_list(p.layer_capacity, "layer_capacity", 0, 100, count);
  double bottom = 0;
  double run = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const double tangent = std::tan(radians(p.layer_angle[k]));
    layers_.push_back({static_cast<float>(p.layer_hardness[k]), static_cast<float>(tangent),
                       static_cast<float>(p.layer_capacity[k])});
    bottom += p.thickness[k];
    run += p.thickness[k] / tangent;
    bottoms_.push_back(static_cast<float>(bottom));
    bottom_runs_.push_back(static_cast<float>(run));
  }
}

Stack::Place Stack::place(float depth) const {
  const float stacks = std::floor(depth / bottoms_.back());
  return {depth - stacks * bottoms_.back(), stacks};
}

int Stack::index_at(float depth) const {
  const float within = place(depth).within;
  int k = 0;
  while (k + 1 < static_cast<int>(bottoms_.size()) &&
         within >= bottoms_[static_cast<std::size_t>(k)])
    ++k;
  return k;
}

float Stack::run_of(float depth) const {
  const Place p = place(depth);
  const auto k = static_cast<std::size_t>(index_at(depth));
  const float run = bottom_runs_[k] - (bottoms_[k] - p.within) / layers_[k].tangent;
  return p.stacks * bottom_runs_.back() + run;
}

}  // namespace wold::layers_detail
