// What drives the water through the pipes, inside the land and over its border.

#include <algorithm>

#include "erosion/pipes_band.hpp"

namespace wold::pipes_detail {

void PipeSolver::drive_inner_x(Band& band, int j) {
  const int row = row_of(j);
  const RowState at = state(row);
  const RowState west{at.ground - 1, at.change - 1, at.depth - 1};
  const float* before = now_.west.row(row);
  const float* south = now_.south.row(row);
  const float* north = now_.south.row(row + 1);
  float* out = band.east.row(j & 1);
  if (!parameters_.momentum) {
    drive(west, at, before, south - 1, north - 1, out, width_ + 1, constants_);
    return;
  }
  const bool mine = j >= band.first && j < band.last;
  drive_x_with_momentum(at, {before, now_.speed_west.row(row)},
                        now_.speed_west.row(near_row(row - 1)),
                        now_.speed_west.row(near_row(row + 1)), south, north, out,
                        mine ? next_.speed_west.row(j) : band.speed.row(0), width_ + 1, constants_);
  if (mine) fill_sides_of_faces(next_.speed_west, j);
}

void PipeSolver::drive_x(Band& band, int j) {
  if (!periodic_ && (j < 0 || j >= height_)) return;
  drive_inner_x(band, j);
  if (periodic_) return;
  float* out = band.east.row(j & 1);
  out[0] = out[width_] = 0;
  if (parameters_.momentum && j >= band.first && j < band.last) {
    float* speed = next_.speed_west.row(j);
    speed[0] = speed[width_] = 0;
  }
  if (parameters_.border != WaterBorder::open) return;
  const RowState at = state(j);
  const float* before = now_.west.row(j);
  const Grains none = 0;
  const float none_across[2] = {0, 0};
  const auto outflow = [&](int edge, int inner, float flow) {
    const float rise = (at.ground[inner] - at.ground[edge]) +
                       metres_per_grain * static_cast<float>(at.change[inner] - at.change[edge]);
    const float beyond = at.ground[edge] - std::max(rise, 0.0F);
    float driven = 0;
    drive({at.ground + edge, at.change + edge, at.depth + edge}, {&beyond, at.change + edge, &none},
          &flow, none_across, none_across, &driven, 1, constants_);
    return driven;
  };
  out[0] = -outflow(0, 1, -before[0]);
  out[width_] = outflow(width_ - 1, width_ - 2, before[width_]);
}

void PipeSolver::drive_inner_y(Band& band, int face) {
  const int row = row_of(face);
  float* out = band.north.row(face & 1);
  const float* before = now_.south.row(row);
  const float* across_a = now_.west.row(row_of(row - 1));
  const float* across_b = now_.west.row(row);
  if (!parameters_.momentum) {
    drive(state(row - 1), state(row), before, across_a, across_b, out, width_, constants_);
    return;
  }
  const bool mine = face >= band.first && face < band.last;
  const auto faces = [&](int f) {
    return FaceState{now_.south.row(row_of(f)), now_.speed_south.row(row_of(f))};
  };
  drive_y_with_momentum(state(row - 1), state(row), faces(row), faces(row - 1), faces(row + 1),
                        across_a, across_b, out,
                        mine ? next_.speed_south.row(face) : band.speed.row(0), width_, constants_);
  if (mine) next_.speed_south.fill_sides(face, periodic_);
}

void PipeSolver::drive_y(Band& band, int face) {
  if (!periodic_ && (face < 0 || face > height_)) return;
  if (periodic_ || (face > 0 && face < height_)) {
    drive_inner_y(band, face);
    return;
  }
  float* out = band.north.row(face & 1);
  const float* before = now_.south.row(face);
  std::fill_n(out, width_, 0.0F);
  if (parameters_.border != WaterBorder::open) return;
  const int edge = face == 0 ? 0 : height_ - 1;
  const RowState at = state(edge);
  const RowState inner = state(face == 0 ? 1 : height_ - 2);
  float* beyond = band.outside.row(0);
  for (int i = 0; i < width_; ++i) {
    const float rise = (inner.ground[i] - at.ground[i]) +
                       metres_per_grain * static_cast<float>(inner.change[i] - at.change[i]);
    beyond[i] = at.ground[i] - std::max(rise, 0.0F);
  }
  const RowState outside{beyond, at.change, band.dry.row(0)};
  const float* across = now_.west.row(edge);
  if (face == 0)
    drive(outside, at, before, across, across, out, width_, constants_);
  else
    drive(at, outside, before, across, across, out, width_, constants_);
}

}  // namespace wold::pipes_detail
