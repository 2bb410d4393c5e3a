#include "erosion/thermal_units.hpp"

#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "terrain/analysis.hpp"

namespace wold {

SlideUnits slide_units(const Heightfield& ground, double below, double above) {
  const HeightStatistics range = height_statistics(ground);
  const double base = static_cast<double>(range.min) - below;
  const double span = std::max(1e-3, static_cast<double>(range.max) + above - base);
  return {base, std::exp2(std::ceil(std::log2(span / slide_range)))};
}

Grid<std::int32_t> in_units(const Grid<float>& height, const SlideUnits& units) {
  Grid<std::int32_t> out(height.width(), height.height());
  parallel_for(0, out.height(), [&](int j) {
    std::transform(height.row(j).begin(), height.row(j).end(), out.row(j).begin(), [&](float h) {
      return static_cast<std::int32_t>(
          std::floor((static_cast<double>(h) - units.base) / units.unit + 0.5));
    });
  });
  return out;
}

Grid<float> changed_heights(const Grid<float>& height, const Grid<std::int32_t>& before,
                            const Grid<std::int32_t>& after, double unit) {
  Grid<float> out = height;
  double carried = 0;
  for (std::size_t k = 0; k < out.size(); ++k) {
    const std::int32_t change = after.values()[k] - before.values()[k];
    if (change == 0) continue;
    const double exact = static_cast<double>(out.values()[k]) + change * unit + carried;
    out.values()[k] = static_cast<float>(exact);
    carried = exact - static_cast<double>(out.values()[k]);
  }
  return out;
}

Grid<float> positive_difference(const Grid<std::int32_t>& a, const Grid<std::int32_t>& b,
                                double scale) {
  Grid<float> out(a.width(), a.height());
  parallel_for(0, out.height(), [&](int j) {
    std::transform(a.row(j).begin(), a.row(j).end(), b.row(j).begin(), out.row(j).begin(),
                   [&](std::int32_t x, std::int32_t y) {
                     return static_cast<float>(scale * std::max(0, x - y));
                   });
  });
  return out;
}

}  // namespace wold
