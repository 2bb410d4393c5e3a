#include <algorithm>
#include <cmath>
#include <utility>

#include "base/parallel.hpp"
#include "erosion/pipes_band.hpp"

namespace wold::pipes_detail {

namespace {

constexpr int steps_between_rains = 8;  // rain, evaporation and slides come every so many steps
constexpr double least_fastest = 0.6;   // of the fastest that may be

double longest_step(double cell, double fastest) {
  return 0.9 * cell / (std::sqrt(2.0) * fastest);
}

StepConstants constants_of(const Pipes& p, double cell, double step) {
  const double tangent = std::tan(radians(static_cast<double>(p.least_slope)));
  const auto share = [&](float rate) {
    return static_cast<float>(-std::expm1(-static_cast<double>(rate) * step));
  };
  StepConstants c;
  c.gravity_step = static_cast<float>(static_cast<double>(gravity) * step / cell);
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

PipeSolver::PipeSolver(PipeStart start, const Pipes& parameters, Progress& progress)
    : parameters_(parameters),
      start_(std::move(start)),
      width_(start_.ground.height.width()),
      height_(start_.ground.height.height()),
      periodic_(parameters.border == WaterBorder::periodic),
      wet_time_(width_, height_) {
  // A grid at a time: with many samples each takes a while.
  const auto make = [&]<class T>(GhostGrid<T>& grid, int width, int height) {
    grid = GhostGrid<T>(width, height);
    progress.advance(0);
  };
  for (Fields* fields : {&now_, &next_}) {
    for (GhostGrid<Grains>* grid : {&fields->depth, &fields->sediment, &fields->change})
      make(*grid, width_, height_);
    make(fields->west, width_ + 1, height_);
    make(fields->south, width_, height_ + 1);
    if (!parameters_.momentum) continue;
    make(fields->speed_west, width_ + 1, height_);
    make(fields->speed_south, width_, height_ + 1);
  }
  for (GhostGrid<float>* grid : {&ground_, &ease_, &rise_, &tangent_, &stir_})
    make(*grid, width_, height_);
  const auto fill = [&]<class T>(GhostGrid<T>& out, const Grid<T>& in) {
    fill_from(out, in, periodic_);
    progress.advance(0);
  };
  fill(ground_, start_.ground.height);
  fill(ease_, start_.ease);
  fill(now_.depth, start_.depth);
  fill(now_.sediment, start_.sediment);
  fill(now_.change, start_.change);
  slid_ = now_.change;
  const int rows = rows_per_band(height_);
  for (int j = 0; j < height_; j += rows)
    bands_.emplace_back(j, std::min(j + rows, height_), width_);
}

PipeSolver::~PipeSolver() = default;

void PipeSolver::run(double seconds, Progress& progress) {
  for (double left = seconds; left > 0;) {
    const double longest = longest_step(start_.ground.cell, fastest_now(progress));
    const double needed = std::ceil(left / longest);
    const bool last = needed <= steps_between_rains;
    const int count = last ? static_cast<int>(needed) : steps_between_rains;
    const double step_seconds = last ? left / needed : longest;
    constants_ = constants_of(parameters_, start_.ground.cell, step_seconds);
    let_rain(count * step_seconds, progress);
    for (int k = 0; k < count; ++k) step(step_seconds, progress);
    let_slide(count * step_seconds, progress);
    left = last ? 0 : left - count * step_seconds;
  }
}

double PipeSolver::fastest_now(Progress& progress) const {
  const double wave = std::sqrt(static_cast<double>(gravity * parameters_.pipe_depth));
  const auto flow = static_cast<double>(parameters_.top_speed);
  if (!parameters_.momentum) return std::max(wave, 1.5 * flow);
  const float now = parallel_reduce(
      0, height_, 0.0F,
      [&](int j) {
        progress.advance(0);
        return fastest(now_.depth.row(j), now_.speed_west.row(j), now_.speed_south.row(j),
                       now_.speed_south.row(periodic_ ? row_of(j + 1) : j + 1), width_,
                       parameters_.pipe_depth);
      },
      [](float a, float b) { return std::max(a, b); }, 16);
  const double most = wave + flow;
  return std::clamp(static_cast<double>(now), least_fastest * most, most);
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

void PipeSolver::step(double seconds, Progress& progress) {
  ++steps_;
  const double seconds_per_row = seconds / height_;
  parallel_for(0, static_cast<int>(bands_.size()), [&](int b) {
    Band& band = bands_[static_cast<std::size_t>(b)];
    progress.advance(seconds_per_row * (band.last - band.first));
    step_band(band);
  });
  for (Band& band : bands_) sums_ += std::exchange(band.sums, {});
  std::swap(now_, next_);
  fill_ends(now_);
}

void PipeSolver::fill_ends(Fields& fields) const {
  fields.depth.fill_ends(periodic_);
  fields.sediment.fill_ends(periodic_);
  fields.change.fill_ends(periodic_);
}

void PipeSolver::step_band(Band& band) {
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
