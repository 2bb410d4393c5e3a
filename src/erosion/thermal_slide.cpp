#include "erosion/thermal_slide.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.hpp"
#include "base/vec.hpp"
#include "erosion/thermal_pass.hpp"
#include "erosion/thermal_rungs.hpp"

namespace wold {

namespace {

constexpr int tile_width = 128;
constexpr int tile_height = 32;
/// K Δt / cell² of the passes: among four neighbours, and among diagonal ones, whose material goes
/// √2 as far, so that it counts twice.
constexpr double straight_rate = 0.2;
constexpr double diagonal_rate = 0.125;
/// Passes before a coarser rung's, so that what one coarse cell cannot show is level enough.
constexpr int first_passes = 12;
constexpr int most_passes = 1 << 27;
/// A ladder's top is small, or there is none: so many times the passes.
constexpr int passes_at_top = 8;
/// A rung is at rest as well when nothing moves on slopes above the angle plus the tolerance;
/// that is looked at after so many passes.
constexpr int passes_between_looks = 16;
/// Thinner films (in cells) that still trickle down do not count.
constexpr double least_depth = 0.02;

template <class T>
Grid<T> framed(const Grid<T>& grid) {
  Grid<T> out(grid.width() + 2 * slide_frame, grid.height() + 2 * slide_frame);
  for (int j = 0; j < grid.height(); ++j)
    std::copy_n(grid.row(j).begin(), grid.width(), &out(slide_frame, j + slide_frame));
  return out;
}

void unframe(const Grid<std::int32_t>& in, Grid<std::int32_t>& out) {
  for (int j = 0; j < out.height(); ++j)
    std::copy_n(&in(slide_frame, j + slide_frame), out.width(), out.row(j).begin());
}

/// The frame goes on as steeply as the ground within does at its border.
void fill_frame(Grid<std::int32_t>& grid) {
  const int w = grid.width() - 2 * slide_frame;
  const int h = grid.height() - 2 * slide_frame;
  const auto on = [](std::int32_t edge, std::int32_t inner) { return 2 * edge - inner; };
  for (int j = slide_frame; j < h + slide_frame; ++j) {
    const std::span<std::int32_t> row = grid.row(j).subspan(slide_frame - 1);
    row[0] = on(row[1], row[2]);
    row[static_cast<std::size_t>(w) + 1] =
        on(row[static_cast<std::size_t>(w)], row[static_cast<std::size_t>(w) - 1]);
  }
  for (int i = slide_frame; i < w + slide_frame; ++i) {
    grid(i, slide_frame - 1) = on(grid(i, slide_frame), grid(i, slide_frame + 1));
    const int last = h + slide_frame - 1;
    grid(i, last + 1) = on(grid(i, last), grid(i, last - 1));
  }
  for (const int j : {slide_frame - 1, h + slide_frame})
    for (const int i : {slide_frame - 1, w + slide_frame})
      grid(i, j) = grid(std::clamp(i, slide_frame, w + slide_frame - 1), j);
}

/// Tiles, and when something moved in each.
class Tiles {
 public:
  Tiles(int width, int height)
      : width_(width),
        height_(height),
        last_moved_((width + tile_width - 1) / tile_width, (height + tile_height - 1) / tile_height,
                    -1) {}

  /// Those where something could move, if nothing does where nothing moved around for `memory`
  /// passes.
  std::vector<IVec2> active(int pass, int memory) const {
    std::vector<IVec2> out;
    for (int j = 0; j < last_moved_.height(); ++j)
      for (int i = 0; i < last_moved_.width(); ++i)
        if (pass - newest_around(i, j) <= memory) out.emplace_back(i, j);
    return out;
  }
  SlideTile tile(IVec2 t) const {
    return {t.x * tile_width, t.y * tile_height, std::min(width_, (t.x + 1) * tile_width),
            std::min(height_, (t.y + 1) * tile_height)};
  }
  void set_moved(IVec2 t, int pass) { last_moved_(t.x, t.y) = pass; }

 private:
  int newest_around(int i, int j) const {
    int newest = -1;
    for (int n = -1; n <= 1; ++n)
      for (int m = -1; m <= 1; ++m) newest = std::max(newest, last_moved_.clamped(i + m, j + n));
    return newest;
  }

  int width_;
  int height_;
  Grid<int> last_moved_;
};

/// One rung of the ladder, sliding.
class Rung {
 public:
  Rung(SlideGround& ground, const SlideRules& rules)
      : ground_(ground), rules_(rules), tiles_(ground.surface.width(), ground.surface.height()) {
    const double cell = ground.cell / ground.unit;
    pass_.width = ground.surface.width();
    pass_.height = ground.surface.height();
    pass_.loose = yield(rules.repose, 0, cell);
    pass_.rock = yield(rules.cliff, 0, cell);
    beyond_.loose = yield(rules.repose, rules.tolerance, cell);
    beyond_.rock = yield(rules.cliff, rules.tolerance, cell);
    if (!ground.hardness.empty()) map_yields(cell);
    load();
  }
  ~Rung() = default;
  Rung(const Rung&) = delete;
  Rung& operator=(const Rung&) = delete;

  SlideWork run(const SlideLimit& limit, Progress& progress) {
    SlideWork work;
    const bool alternating = rules_.neighbours == SlideNeighbours::alternating;
    const double area = ground_.cell * ground_.cell;
    double left = limit.spread > 0 ? limit.spread : std::numeric_limits<double>::infinity();
    while (left > 0 && (limit.passes == 0 || work.passes < limit.passes)) {
      pass_.diagonal =
          rules_.neighbours == SlideNeighbours::diagonals || (alternating && work.passes % 2 == 1);
      const double weight = pass_.diagonal ? 2 : 1;
      const double full = (pass_.diagonal ? diagonal_rate : straight_rate) * weight * area;
      const double step = std::min(full, left);
      left = step < left ? left - step : 0;
      pass_.rate = static_cast<float>(step / (weight * area));
      const std::vector<IVec2> active = tiles_.active(work.passes, alternating ? 2 : 1);
      work.at_rest =
          active.empty() || (!(limit.spread > 0) && looks_at_rest(work, active, progress));
      if (work.at_rest) break;
      work.cell_passes += sweep(active, work.passes, progress);
      ++work.passes;
      progress.advance();
    }
    return work;
  }

  /// To the ground.
  void store() {
    unframe(surface_[0], ground_.surface);
    if (!ground_.bed.empty()) unframe(bed_[0], ground_.bed);
  }
  /// From the ground; everything may move again.
  void load() {
    surface_[0] = surface_[1] = framed(ground_.surface);
    if (!ground_.bed.empty()) bed_[0] = bed_[1] = framed(ground_.bed);
    fill_frame(surface_[0]);
    tiles_ = Tiles(ground_.surface.width(), ground_.surface.height());
  }

 private:
  /// Of an angle: to move from `above` degrees beyond it on, towards two tolerances below it.
  SlideYield yield(double angle, double above, double cell) const {
    const double towards = angle - 2 * rules_.tolerance;
    return {slide_step(angle < 90 ? angle + above : 90, cell),
            slide_step(angle < 90 ? towards : 90, cell)};
  }

  void map_yields(double cell) {
    const double angle = ground_.bed.empty() ? rules_.repose : rules_.cliff;
    rest_ = flow_ = beyond_rest_ = framed(ground_.hardness);
    parallel_for(0, rest_.height(), [&](int j) {
      for (int i = 0; i < rest_.width(); ++i) {
        const double hard = angle + static_cast<double>(rest_(i, j)) * (90 - angle);
        rest_(i, j) = yield(hard, 0, cell).rest;
        flow_(i, j) = yield(hard, 0, cell).flow;
        beyond_rest_(i, j) = yield(hard, rules_.tolerance, cell).rest;
      }
    });
    pass_.rest_map = rest_;
    beyond_.rest_map = beyond_rest_;
    pass_.flow_map = beyond_.flow_map = flow_;
  }

  /// Moves nothing: whether nothing would on slopes beyond the tolerance.
  bool looks_at_rest(const SlideWork& work, const std::vector<IVec2>& active, Progress& progress) {
    if (work.passes % passes_between_looks != passes_between_looks - 1) return false;
    SlidePass look = pass_;
    look.loose = beyond_.loose;
    look.rock = beyond_.rock;
    look.rest_map = beyond_.rest_map;
    look.rate = 1;
    look.least = static_cast<std::int32_t>(least_depth * ground_.cell / ground_.unit);
    for (const bool diagonal : {false, true}) {
      const auto only = diagonal ? SlideNeighbours::four : SlideNeighbours::diagonals;
      if (rules_.neighbours == only) continue;
      look.diagonal = diagonal;
      for (const char moved : pass_over(look, active, progress))
        if (moved != 0) return false;
    }
    return true;
  }

  /// From the first surface to the second; where something moved.
  std::vector<char> pass_over(const SlidePass& pass, const std::vector<IVec2>& active,
                              Progress& progress) {
    std::vector<char> moved(active.size(), 0);
    parallel_for(0, static_cast<int>(active.size()), [&](int t) {
      thread_local SlideScratch scratch;
      const auto k = static_cast<std::size_t>(t);
      const SlideTile tile = tiles_.tile(active[k]);
      moved[k] = ground_.bed.empty() ? slide_tile(pass, tile, surface_[0], surface_[1], scratch)
                                     : slide_layers_tile(pass, tile, surface_[0], bed_[0],
                                                         surface_[1], bed_[1], scratch);
      progress.advance(0);
    });
    return moved;
  }

  /// Returns over how many cells it went.
  double sweep(const std::vector<IVec2>& active, int pass, Progress& progress) {
    const std::vector<char> moved = pass_over(pass_, active, progress);
    double cells = 0;
    for (std::size_t k = 0; k < active.size(); ++k) {
      if (moved[k] != 0) tiles_.set_moved(active[k], pass);
      const SlideTile tile = tiles_.tile(active[k]);
      cells += static_cast<double>(tile.i1 - tile.i0) * (tile.j1 - tile.j0);
    }
    std::swap(surface_[0], surface_[1]);
    std::swap(bed_[0], bed_[1]);
    fill_frame(surface_[0]);
    return cells;
  }

  SlideGround& ground_;
  SlideRules rules_;
  SlidePass pass_;
  SlidePass beyond_;  ///< the yields of `pass_` and a tolerance
  Grid<std::int32_t> surface_[2];
  Grid<std::int32_t> bed_[2];
  Grid<float> rest_;
  Grid<float> flow_;
  Grid<float> beyond_rest_;
  Tiles tiles_;
};

SlideWork slide_rung(SlideGround& ground, const SlideRules& rules, const SlideLimit& limit,
                     bool with_ladder, Progress& progress) {
  double before = 0;
  int factor = 1;
  Rung rung(ground, rules);
  if (with_ladder && !has_coarser_rung(ground)) factor = passes_at_top;
  if (with_ladder && has_coarser_rung(ground)) {
    before = rung.run({0, std::min(first_passes, limit.passes)}, progress).cell_passes;
    rung.store();
    SlideGround coarse = coarser_rung(ground);
    const SlideGround unchanged = coarse;
    const int passes = 2 * std::min(limit.passes, most_passes);
    before += slide_rung(coarse, rules, {0, passes}, true, progress).cell_passes;
    lay_over(ground, unchanged, coarse);
    rung.load();
  }
  SlideWork work = rung.run({limit.spread, factor * std::min(limit.passes, most_passes)}, progress);
  rung.store();
  work.cell_passes += before;
  return work;
}

}  // namespace

SlideWork slide(SlideGround& ground, const SlideRules& rules, const SlideLimit& limit,
                bool with_ladder, Progress& progress) {
  return slide_rung(ground, rules, limit, with_ladder && !(limit.spread > 0), progress);
}

double steepest_step(const Grid<float>& height, double cell) {
  const auto rise = [&](int i, int j, int m, int n) {
    if (i + m < 0 || i + m >= height.width() || j + n >= height.height()) return 0.0;
    const double h = static_cast<double>(height(i, j)) - static_cast<double>(height(i + m, j + n));
    return std::abs(h) / (cell * std::hypot(m, n));
  };
  const double steepest = parallel_reduce(
      0, height.height(), 0.0,
      [&](int j) {
        double most = 0;
        for (int i = 0; i < height.width(); ++i)
          most = std::max(
              {most, rise(i, j, 1, 0), rise(i, j, 0, 1), rise(i, j, 1, 1), rise(i, j, -1, 1)});
        return most;
      },
      [](double a, double b) { return std::max(a, b); });
  return degrees(std::atan(steepest));
}

}  // namespace wold
