#include "erosion/stream_power_mesh.hpp"

#include "base/hash.hpp"
#include "erosion/flow_routing.hpp"
#include "terrain/field_map.hpp"

namespace wold {

StreamPowerMesh::StreamPowerMesh(const Heightfield& grid, std::uint64_t seed, bool real)
    : is_real(real) {
  const int w = grid.height.width();
  const int h = grid.height.height();
  x_shift_ = y_shift_ = {Grid<float>(w, h, 0), grid.origin, grid.cell};
  const float reach = shift * static_cast<float>(grid.cell);
  parallel_for(1, std::max(1, h - 1), [&](int j) {
    for (int i = 1; i < w - 1; ++i) {
      x_shift_.height(i, j) = reach * (2 * uniform(random_bits(seed, i, j, 0)) - 1);
      y_shift_.height(i, j) = reach * (2 * uniform(random_bits(seed, i, j, 1)) - 1);
    }
  });
}

DVec2 StreamPowerMesh::shift_at(DVec2 x) const {
  return {ground_at(x_shift_, x).height, ground_at(y_shift_, x).height};
}

Grid<float> StreamPowerMesh::nearness(int d, Progress& progress) const {
  const Grid<float>& dx = x_shift_.height;
  const Grid<float>& dy = y_shift_.height;
  const int step_x = flow_dx[static_cast<std::size_t>(d)];
  const int step_y = flow_dy[static_cast<std::size_t>(d)];
  return map_grid<float>(x_shift_, progress, [&](int i, int j) {
    const int x = i + step_x;
    const int y = j + step_y;
    if (x < 0 || x >= dx.width() || y >= dx.height()) return 1.0F;
    const auto cell = static_cast<float>(x_shift_.cell);
    const Vec2 way{static_cast<float>(step_x) + (dx(x, y) - dx(i, j)) / cell,
                   static_cast<float>(step_y) + (dy(x, y) - dy(i, j)) / cell};
    return 1 / std::max(0.2F, glm::length(way));
  });
}

Grid<float> StreamPowerMesh::shifted(const Heightfield& field, Progress& progress) const {
  if (!is_real) return field.height;
  return map_grid<float>(field, progress, [&](int i, int j) {
    const DVec2 away{x_shift_.height(i, j), y_shift_.height(i, j)};
    return ground_at(field, place_of(field, i, j) + away).height;
  });
}

Grid<float> StreamPowerMesh::laid_over(const Grid<float>& values, const StreamPowerMesh& finer,
                                       Progress& progress) const {
  const Heightfield field{values, x_shift_.origin, x_shift_.cell};
  return map_grid<float>(finer.x_shift_, progress, [&](int i, int j) {
    DVec2 place = place_of(finer.x_shift_, i, j);
    if (finer.is_real) place += DVec2{finer.x_shift_.height(i, j), finer.y_shift_.height(i, j)};
    DVec2 x = place;
    for (int k = 0; k < 3; ++k) x = place - shift_at(x);
    return ground_at(field, x).height;
  });
}

}  // namespace wold
