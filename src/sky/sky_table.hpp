#pragma once
// The coordinates of the table in class Sky, which need no trigonometry to look up. Around the
// compass, "diamond angle": along each quadrant y / (|x| + |y|), 0 to 1. Up and down, s with
// s² = |z| / (|z| + across), so rows are finest at the horizon.

#include "base/grid.hpp"
#include "base/vec.hpp"

namespace wold::sky_table {

inline constexpr int columns = 512;
inline constexpr int cell_rows = 256;  // half of them above the horizon
inline constexpr int horizon = cell_rows / 2;

double column_azimuth(int column);  ///< radians from east to north, [0, 2π]
double column_width(int column);
double row_elevation(int row);  ///< radians

struct Place {
  float column = 0;  ///< in [0, columns]
  float row = 0;     ///< in [0, cell_rows]
};
Place place_of(Vec3 direction);
Vec3 interpolated(const Grid<Vec3>& nodes, Vec3 direction);

}  // namespace wold::sky_table
