#include "erosion/pipes_solver.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/parallel.hpp"

namespace wold::pipes_detail {

namespace {

constexpr double gravity = 9.81;        // m/s²
constexpr int steps_between_rains = 8;  // rain, evaporation and slides come every so many steps

/// The longest stable step, s: the header's bound.
double longest_step(double cell, const Pipes& p) {
  const double wave = std::sqrt(gravity * static_cast<double>(p.pipe_depth));
  const auto speed = static_cast<double>(p.top_speed);
  const double fastest = p.momentum ? wave + speed : std::max(wave, 1.5 * speed);
  return 0.9 * cell / (std::sqrt(2.0) * fastest);
}

StepConstants constants_of(const Pipes& p, double cell, double step) {
  const double tangent = std::tan(radians(static_cast<double>(p.least_slope)));
  const auto share = [&](float rate) {
    return static_cast<float>(-std::expm1(-static_cast<double>(rate) * step));
  };
  StepConstants c;
  c.gravity_step = static_cast<float>(gravity * step / cell);
  c.drag_step = static_cast<float>(static_cast<double>(p.drag) * step);
  c.pipe_depth = p.pipe_depth;
  c.top_speed = p.top_speed;
  c.speed_step = static_cast<float>(step / cell);
  c.grains_per_flux = static_cast<float>(step / cell) * grains_per_metre;
  c.half_per_cell = static_cast<float>(0.5 / cell);
  c.capacity = p.capacity / p.full_depth * grains_per_metre;
  c.least_sine = static_cast<float>(std::sin(radians(static_cast<double>(p.least_slope))));
  c.full_depth = p.full_depth;
  c.dissolve = share(p.dissolving);
  c.deposit = share(p.depositing);
  c.least_drop = static_cast<float>(cell * tangent) * grains_per_metre;
  return c;
}

template <class T>
void fill_from(GhostGrid<T>& out, const Grid<T>& in, bool periodic) {
  for (int j = 0; j < in.height(); ++j) {
    std::copy(in.row(j).begin(), in.row(j).end(), out.row(j));
    out.fill_sides(j, periodic);
  }
  out.fill_ends(periodic);
}

int rows_per_band(int height) {
  return std::clamp(height / 12, 16, 64);
}

}  // namespace

GrainSums& GrainSums::operator+=(const GrainSums& b) {
  water_in += b.water_in;
  water_evaporated += b.water_evaporated;
  water_out += b.water_out;
  sediment_out += b.sediment_out;
  taken_up += b.taken_up;
  return *this;
}

/// Rows [first, last) and the rows of working values that roll over them; two of each kind, for
/// even and odd rows.
struct PipeSolver::Band {
  Band(int first_row, int last_row, int width)
      : first(first_row),
        last(last_row),
        east(width + 1, 2),
        north(width, 2),
        share(width, 2),
        load(width, 2),
        discharge_y(width, 2),
        speed(width + 1, 1),
        water_x(width + 1, 1),
        sediment_x(width + 1, 1),
        water_y(width, 2),
        sediment_y(width, 2),
        moved(width, 1),
        outside(width, 1),
        dry(width, 1) {}

  int first;
  int last;
  GhostGrid<float> east;   ///< driven through western faces
  GhostGrid<float> north;  ///< driven through southern faces
  GhostGrid<float> share;
  GhostGrid<float> load;
  GhostGrid<float> discharge_y;
  GhostGrid<float> speed;  ///< of faces that the band beside keeps
  GhostGrid<Grains> water_x;
  GhostGrid<Grains> sediment_x;
  GhostGrid<Grains> water_y;
  GhostGrid<Grains> sediment_y;
  GhostGrid<Grains> moved;
  GhostGrid<float> outside;  ///< ground beyond an open border
  GhostGrid<Grains> dry;     ///< zeros
  FaceRow faces_y[2] = {};
  GrainSums sums;
};

PipeSolver::PipeSolver(PipeStart start, const Pipes& parameters)
    : parameters_(parameters),
      start_(std::move(start)),
      width_(start_.ground.height.width()),
      height_(start_.ground.height.height()),
      periodic_(parameters.border == WaterBorder::periodic),
      ground_(width_, height_),
      ease_(width_, height_),
      rise_(width_, height_),
      tangent_(width_, height_),
      stir_(width_, height_),
      wet_time_(width_, height_) {
  fill_from(ground_, start_.ground.height, periodic_);
  fill_from(ease_, start_.ease, periodic_);
  now_ = {{width_, height_},
          {width_, height_},
          {width_, height_},
          {width_ + 1, height_},
          {width_, height_ + 1},
          {},
          {}};
  if (parameters_.momentum) {
    now_.speed_west = now_.west;
    now_.speed_south = now_.south;
  }
  next_ = now_;
  fill_from(now_.depth, start_.depth, periodic_);
  fill_from(now_.sediment, start_.sediment, periodic_);
  fill_from(now_.change, start_.change, periodic_);
  slid_ = now_.change;
  const int rows = rows_per_band(height_);
  for (int j = 0; j < height_; j += rows)
    bands_.emplace_back(j, std::min(j + rows, height_), width_);
}

PipeSolver::~PipeSolver() = default;

double PipeSolver::step_count(double seconds, double cell, const Pipes& parameters) {
  return std::ceil(seconds / longest_step(cell, parameters));
}

void PipeSolver::run(double seconds, Progress& progress) {
  const double steps = step_count(seconds, start_.ground.cell, parameters_);
  if (steps < 1) return;
  const double step_seconds = seconds / steps;
  constants_ = constants_of(parameters_, start_.ground.cell, step_seconds);
  for (double done = 0; done < steps;) {
    const int count = static_cast<int>(std::min(steps - done, 1.0 * steps_between_rains));
    let_rain(count * step_seconds, progress);
    for (int k = 0; k < count; ++k) step(progress);
    let_slide(count * step_seconds, progress);
    done += count;
  }
}

int PipeSolver::row_of(int j) const {
  return periodic_ ? (j + height_) % height_ : j;
}

int PipeSolver::near_row(int j) const {
  return periodic_ ? row_of(j) : std::clamp(j, 0, height_ - 1);
}

/// The first and the last of the western faces of a periodic row are the same.
void PipeSolver::fill_sides_of_faces(GhostGrid<float>& faces, int j) const {
  if (!periodic_) return;
  float* row = faces.row(j);
  row[-1] = row[width_ - 1];
  row[width_ + 1] = row[1];
}

RowState PipeSolver::state(int j) const {
  return {ground_.row(j), now_.change.row(j), now_.depth.row(j)};
}

void PipeSolver::step(Progress& progress) {
  parallel_for(0, static_cast<int>(bands_.size()), [&](int b) { step_band(b, progress); });
  for (Band& band : bands_) sums_ += std::exchange(band.sums, {});
  std::swap(now_, next_);
  fill_ends(now_);
}

void PipeSolver::fill_ends(Fields& fields) const {
  fields.depth.fill_ends(periodic_);
  fields.sediment.fill_ends(periodic_);
  fields.change.fill_ends(periodic_);
}

void PipeSolver::step_band(int index, Progress& progress) {
  Band& band = bands_[static_cast<std::size_t>(index)];
  progress.advance(static_cast<double>(width_) * (band.last - band.first));
  std::fill_n(band.moved.row(0), width_, 0);
  drive_y(band, band.first - 1);
  for (int j = band.first - 1; j <= band.last; ++j) {
    drive_y(band, j + 1);
    drive_x(band, j);
    limit_row(band, j);
    if (j >= band.first) pass_y(band, j, j < band.last || j == height_);
    if (j > band.first) finish_row(band, j - 1);
  }
  const Grains* moved = band.moved.row(0);
  for (int i = 0; i < width_; ++i) band.sums.taken_up += moved[i];
}

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
  const float* speed = now_.speed_west.row(row);
  drive_with_momentum(west, at,
                      {before, before - 1, before + 1, speed, speed - 1, speed + 1,
                       now_.speed_west.row(near_row(row - 1)),
                       now_.speed_west.row(near_row(row + 1)), south - 1, south, north - 1, north},
                      out, mine ? next_.speed_west.row(j) : band.speed.row(0), width_ + 1,
                      constants_);
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
  const int back = row_of(row - 1);
  const int ahead = row_of(row + 1);
  const float* speed = now_.speed_south.row(row);
  drive_with_momentum(state(row - 1), state(row),
                      {before, now_.south.row(back), now_.south.row(ahead), speed,
                       now_.speed_south.row(back), now_.speed_south.row(ahead), speed - 1,
                       speed + 1, across_a, across_b, across_a + 1, across_b + 1},
                      out, mine ? next_.speed_south.row(face) : band.speed.row(0), width_,
                      constants_);
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

void PipeSolver::limit_row(Band& band, int j) const {
  if (!periodic_ && (j < 0 || j >= height_)) return;
  const int row = row_of(j);
  limit(now_.depth.row(row), now_.sediment.row(row), band.east.row(j & 1), band.north.row(j & 1),
        band.north.row((j + 1) & 1), band.share.row(j & 1), band.load.row(j & 1), width_,
        constants_);
  band.share.fill_sides(j & 1, periodic_);
  band.load.fill_sides(j & 1, periodic_);
}

void PipeSolver::pass_y(Band& band, int face, bool owner) {
  const int at = face & 1;
  const int below = at ^ 1;
  float* discharge = owner ? next_.south.row(face) : band.discharge_y.row(at);
  band.faces_y[at] = {discharge, band.water_y.row(at), band.sediment_y.row(at)};
  pass(band.north.row(at), band.share.row(below), band.share.row(at), band.load.row(below),
       band.load.row(at), band.faces_y[at], width_, constants_);
  if (owner) next_.south.fill_sides(face, periodic_);
  if (periodic_ || (face != 0 && face != height_)) return;
  const int sign = face == 0 ? -1 : 1;
  for (int i = 0; i < width_; ++i) {
    band.sums.water_out += sign * band.faces_y[at].water[i];
    band.sums.sediment_out += sign * band.faces_y[at].sediment[i];
  }
}

void PipeSolver::finish_row(Band& band, int j) {
  const int at = j & 1;
  const FaceRow west{next_.west.row(j), band.water_x.row(0), band.sediment_x.row(0)};
  pass(band.east.row(at), band.share.row(at) - 1, band.share.row(at), band.load.row(at) - 1,
       band.load.row(at), west, width_ + 1, constants_);
  fill_sides_of_faces(next_.west, j);
  if (!periodic_) {
    band.sums.water_out += west.water[width_] - west.water[0];
    band.sums.sediment_out += west.sediment[width_] - west.sediment[0];
  }
  exchange({west, band.faces_y[at], band.faces_y[at ^ 1], state(j - 1), state(j), state(j + 1),
            now_.sediment.row(j), ease_.row(j)},
           next_.depth.row(j), next_.sediment.row(j), next_.change.row(j), band.moved.row(0),
           width_, constants_);
  if (parameters_.border == WaterBorder::open) hold_border(band, j);
  next_.depth.fill_sides(j, periodic_);
  next_.sediment.fill_sides(j, periodic_);
  next_.change.fill_sides(j, periodic_);
}

void PipeSolver::hold_border(Band& band, int j) {
  const bool end = j == 0 || j == height_ - 1;
  const int inner_row = j == 0 ? 1 : height_ - 2;
  const RowState at = state(j);
  Grains* change = next_.change.row(j);
  Grains* sediment = next_.sediment.row(j);
  for (int i = 0; i < width_; i += end ? 1 : width_ - 1) {
    const RowState inner = end ? state(inner_row) : at;
    const int k = end ? i : (i == 0 ? 1 : width_ - 2);
    const float drop = (at.ground[i] - inner.ground[k]) +
                       metres_per_grain * static_cast<float>(at.change[i] - inner.change[k]);
    const auto most = static_cast<Grains>(0.25F * grains_per_metre * std::max(drop, 0.0F));
    const Grains taken = at.change[i] - change[i];
    const Grains given_back = std::max(taken - most, 0);
    change[i] += given_back;
    sediment[i] -= given_back;
    band.moved.row(0)[i] -= given_back;
  }
}

Grid<Grains> PipeSolver::copy_of(const GhostGrid<Grains>& grid) {
  Grid<Grains> out(grid.width(), grid.height());
  for (int j = 0; j < grid.height(); ++j)
    std::copy_n(grid.row(j), grid.width(), out.row(j).begin());
  return out;
}

Grid<float> PipeSolver::velocity_x() const {
  Grid<float> out(width_, height_);
  for (int j = 0; j < height_; ++j)
    for (int i = 0; i < width_; ++i)
      out(i, j) = speed_of(now_.west.row(j)[i], now_.west.row(j)[i + 1], now_.depth.row(j)[i],
                           parameters_.top_speed);
  return out;
}

Grid<float> PipeSolver::velocity_y() const {
  Grid<float> out(width_, height_);
  for (int j = 0; j < height_; ++j)
    for (int i = 0; i < width_; ++i)
      out(i, j) = speed_of(now_.south.row(j)[i], now_.south.row(j + 1)[i], now_.depth.row(j)[i],
                           parameters_.top_speed);
  return out;
}

Grid<float> PipeSolver::wetness() const {
  Grid<float> out = wet_time_;
  const auto whole = static_cast<float>(std::max(time_, 1e-9));
  for (float& w : out.values()) w /= whole;
  return out;
}

}  // namespace wold::pipes_detail
