#include "erosion/pipes_input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "erosion/ground.hpp"
#include "erosion/pipes_ladder.hpp"
#include "terrain/step_mask.hpp"

namespace wold::pipes_detail {

void check_springs(const Heightfield& input, const Pipes& p) {
  if (p.spring_places.size() != 2 * p.spring_rates.size())
    throw Error(ErrorKind::input,
                fmt::format("'spring_places' needs an x and a y for each of the 'spring_rates'; "
                            "there are {} numbers for {} rates",
                            p.spring_places.size(), p.spring_rates.size()));
  for (std::size_t k = 0; k < p.spring_rates.size(); ++k) {
    const DVec2 place(p.spring_places[2 * k], p.spring_places[2 * k + 1]);
    if (!(p.spring_rates[k] >= 0) || p.spring_rates[k] > 1e6)
      throw Error(ErrorKind::input,
                  fmt::format("'spring_rates' are 0 to 1e+06 m³/s, not {:g}", p.spring_rates[k]));
    if (!input.contains(place))
      throw Error(ErrorKind::input,
                  fmt::format("'spring_places' has ({:g}, {:g}), which is not on the land: x goes "
                              "from {:g} to {:g}, y from {:g} to {:g}",
                              place.x, place.y, input.origin.x, input.origin.x + input.size().x,
                              input.origin.y, input.origin.y + input.size().y));
  }
}

namespace {

/// Adds a spring's water to the cells around it, more in the middle.
void add_spring(Grid<float>& inflow, const Heightfield& ground, DVec2 place, double rate,
                double radius) {
  const double reach = std::max(radius, 1.5 * ground.cell);
  const DVec2 at = (place - ground.origin) / ground.cell;
  const double cells = reach / ground.cell;
  const auto weight = [&](int i, int j) {
    return std::max(0.0, cells - glm::length(DVec2(i, j) - at));
  };
  const auto each = [&](const auto& function) {
    const int i0 = std::max(0, static_cast<int>(at.x - cells));
    const int j0 = std::max(0, static_cast<int>(at.y - cells));
    const int i1 = std::min(inflow.width() - 1, static_cast<int>(at.x + cells) + 1);
    const int j1 = std::min(inflow.height() - 1, static_cast<int>(at.y + cells) + 1);
    for (int j = j0; j <= j1; ++j)
      for (int i = i0; i <= i1; ++i) function(i, j);
  };
  double sum = 0;
  each([&](int i, int j) { sum += weight(i, j); });
  const double per_weight = rate / (sum * ground.cell * ground.cell);
  each([&](int i, int j) { inflow(i, j) += static_cast<float>(weight(i, j) * per_weight); });
}

}  // namespace

Grid<float> inflow_over(const Heightfield& ground, const Grid<float>& rain, const Pipes& p) {
  Grid<float> inflow = rain;
  const float metres_per_second = p.rain / 1000 / 3600;
  for (float& v : inflow.values()) v = std::clamp(v, 0.0F, 1.0F) * metres_per_second;
  for (std::size_t k = 0; k < p.spring_rates.size(); ++k)
    add_spring(inflow, ground, {p.spring_places[2 * k], p.spring_places[2 * k + 1]},
               p.spring_rates[k], static_cast<double>(p.spring_radius));
  return inflow;
}

Grid<float> depth_map(const Heightfield& input, const std::string& name,
                      const TerrainContext& context) {
  if (name.empty()) return {input.height.width(), input.height.height(), 0};
  Grid<float> water = map_over(input, name, context);
  for (float& d : water.values()) {
    if (!std::isfinite(d) || d > deepest_at_first)
      throw Error(ErrorKind::input,
                  fmt::format("the map '{}' of 'water' holds depths beyond 0 to {:g} m", name,
                              static_cast<double>(deepest_at_first)));
    d = std::max(d, 0.0F);
  }
  return water;
}

Grid<float> ease_of(const Heightfield& input, const std::string& hardness, bool invert,
                    const TerrainContext& context) {
  Grid<float> ease = factor_map(input, hardness, invert ? 1.0F : 0.0F, context);
  if (!invert)
    for (float& e : ease.values()) e = 1 - e;
  return ease;
}

Heightfield changed_ground(const Heightfield& input, const Grid<Grains>& change,
                           const Grid<Grains>& carried, std::map<std::string, Grid<float>>& maps,
                           Progress& progress) {
  Heightfield out = input;
  Grid<float> laid(change.width(), change.height());
  Grid<float> worn = laid;
  double left = 0;  // what rounding to float leaves goes to the next sample
  for (int j = 0; j < change.height(); ++j) {
    progress.advance(0);
    for (int i = 0; i < change.width(); ++i) {
      const Grains grains = change(i, j) + carried(i, j);
      if (grains == 0) continue;
      const double metres = static_cast<double>(metres_per_grain) * grains;
      const double exact = static_cast<double>(input.height(i, j)) + metres + left;
      const auto rounded = static_cast<float>(exact);
      left = exact - static_cast<double>(rounded);
      out.height(i, j) = rounded;
      laid(i, j) = static_cast<float>(std::max(metres, 0.0));
      worn(i, j) = static_cast<float>(std::max(-metres, 0.0));
    }
  }
  maps["sediment"] = std::move(laid);
  maps["wear"] = std::move(worn);
  maps["carried"] = to_metres(carried);
  return out;
}

}  // namespace wold::pipes_detail
