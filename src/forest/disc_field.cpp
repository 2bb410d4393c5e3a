#include "forest/disc_field.hpp"

#include <algorithm>
#include <cmath>

namespace wold {

DiscField::DiscField(DVec2 low, DVec2 high, std::span<const float> class_radius) : low_(low) {
  for (const float radius : class_radius) {
    Layer layer;
    // Discs of a class that is hardly used should not cost a grid of millions of cells.
    constexpr double most_cells = 1 << 20;
    const DVec2 size = glm::max(high - low, DVec2(1e-6));
    layer.cell =
        std::max(2.0 * static_cast<double>(radius), std::sqrt(size.x * size.y / most_cells));
    layer.columns = static_cast<int>(size.x / layer.cell) + 1;
    layer.rows = static_cast<int>(size.y / layer.cell) + 1;
    layer.first.assign(
        static_cast<std::size_t>(layer.columns) * static_cast<std::size_t>(layer.rows), -1);
    layers_.push_back(std::move(layer));
  }
}

IVec2 DiscField::cell_of(const Layer& layer, DVec2 place) const {
  const DVec2 p = (place - low_) / layer.cell;
  return {std::clamp(static_cast<int>(std::floor(p.x)), 0, layer.columns - 1),
          std::clamp(static_cast<int>(std::floor(p.y)), 0, layer.rows - 1)};
}

DiscFit DiscField::test(DVec2 centre, float radius, int size_class) const {
  DiscFit fit = DiscFit::free;
  for (int k = 0; k <= size_class; ++k) {
    const Layer& layer = layers_[static_cast<std::size_t>(k)];
    const IVec2 at = cell_of(layer, centre);
    const int last_row = std::min(at.y + 1, layer.rows - 1);
    const int last_column = std::min(at.x + 1, layer.columns - 1);
    for (int j = std::max(at.y - 1, 0); j <= last_row; ++j)
      for (int i = std::max(at.x - 1, 0); i <= last_column; ++i)
        for (std::int32_t d = layer.first[static_cast<std::size_t>(j) * layer.columns + i];
             d >= 0;) {
          const Disc& disc = discs_[static_cast<std::size_t>(d)];
          d = disc.next;
          const DVec2 apart = disc.centre - centre;
          const double reach = static_cast<double>(disc.radius) + static_cast<double>(radius);
          if (glm::dot(apart, apart) >= reach * reach) continue;
          if (disc.certain) return DiscFit::taken;
          fit = DiscFit::uncertain;
        }
  }
  return fit;
}

void DiscField::add(DVec2 centre, float radius, int size_class, bool certain) {
  Layer& layer = layers_[static_cast<std::size_t>(size_class)];
  const IVec2 at = cell_of(layer, centre);
  std::int32_t& first = layer.first[static_cast<std::size_t>(at.y) * layer.columns + at.x];
  discs_.push_back({centre, radius, first, certain});
  first = static_cast<std::int32_t>(discs_.size()) - 1;
}

}  // namespace wold
