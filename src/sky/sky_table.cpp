#include "sky/sky_table.hpp"

#include <algorithm>
#include <cmath>

namespace wold::sky_table {

namespace {

constexpr int quadrant = columns / 4;

}  // namespace

double column_azimuth(int column) {
  const int turns = column / quadrant;
  const double t = static_cast<double>(column % quadrant) / quadrant;
  return turns * (0.5 * pi_d) + std::atan2(t, 1 - t);
}

double row_elevation(int row) {
  const double s = 2.0 * row / cell_rows - 1;
  return std::copysign(std::atan2(s * s, 1 - s * s), s);
}

double column_width(int column) {
  return column_azimuth(column + 1) - column_azimuth(column);
}

Place place_of(Vec3 direction) {
  const float across = std::sqrt(direction.x * direction.x + direction.y * direction.y);
  const float steep = std::abs(direction.z) / (std::abs(direction.z) + across);
  const float s = std::copysign(std::sqrt(steep), direction.z);
  const float sum = std::max(std::abs(direction.x) + std::abs(direction.y), 1e-30F);
  const float t = direction.y / sum;
  const float turn = direction.x < 0 ? 2 - t : (t < 0 ? 4 + t : t);
  return {turn * quadrant, 0.5F * (s + 1) * cell_rows};
}

Vec3 interpolated(const Grid<Vec3>& nodes, Vec3 direction) {
  const Place place = place_of(direction);
  const int i = std::min(static_cast<int>(place.column), columns - 1);
  const int j = std::min(static_cast<int>(place.row), cell_rows - 1);
  const float x = place.column - static_cast<float>(i);
  const float y = place.row - static_cast<float>(j);
  const int next = i + 1 == columns ? 0 : i + 1;
  const Vec3 below = glm::mix(nodes(i, j), nodes(next, j), x);
  const Vec3 above = glm::mix(nodes(i, j + 1), nodes(next, j + 1), x);
  return glm::mix(below, above, y);
}

}  // namespace wold::sky_table
