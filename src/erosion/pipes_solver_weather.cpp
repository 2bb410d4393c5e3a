// What happens between the steps of the pipe model: rain, evaporation, slides.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "erosion/pipes_solver.hpp"

namespace wold::pipes_detail {

namespace {

constexpr float wet_depth = 0.01F;   // m
constexpr Grains deepest = 1 << 30;  // grains; half of what an integer holds

}  // namespace

void PipeSolver::let_rain(double seconds, Progress& progress) {
  // What is less than a grain comes by turns: in the mean nothing is lost to rounding.
  const double golden = 0.6180339887498949;
  const auto turn = static_cast<float>(std::fmod(++rains_ * golden, 1.0));
  const double grains = seconds * static_cast<double>(grains_per_metre);
  const auto rain_step = static_cast<float>(grains);
  const auto lost = static_cast<float>(
      -std::expm1(-static_cast<double>(parameters_.evaporation) * seconds / 3600));
  const auto passed = static_cast<float>(seconds);
  time_ += seconds;
  std::vector<GrainSums> sums(static_cast<std::size_t>(height_));
  parallel_for(
      0, height_,
      [&](int j) {
        progress.advance(0);
        Grains* depth = now_.depth.row(j);
        const float* inflow = start_.inflow.row(j).data();
        float* wet = wet_time_.row(j).data();
        std::int64_t in = 0;
        std::int64_t out = 0;
        Grains most = 0;
        for (int i = 0; i < width_; ++i) {
          const auto gained = static_cast<Grains>(inflow[i] * rain_step + turn);
          const Grains held = depth[i] + gained;
          const auto gone = static_cast<Grains>(static_cast<float>(held) * lost + turn);
          const Grains evaporated = lost > 0 ? std::min(gone, held) : 0;
          depth[i] = held - evaporated;
          in += gained;
          out += evaporated;
          most = std::max(most, held);
          wet[i] += metres_per_grain * static_cast<float>(held) >= wet_depth ? passed : 0.0F;
        }
        if (most > deepest)
          throw Error(ErrorKind::limit,
                      fmt::format("'pipes' counts water up to {:g} m deep; here it gets deeper",
                                  static_cast<double>(metres_per_grain) * deepest));
        sums[static_cast<std::size_t>(j)] = {in, out, 0, 0, 0};
        now_.depth.fill_sides(j, periodic_);
      },
      16);
  for (const GrainSums& s : sums) sums_ += s;
  now_.depth.fill_ends(periodic_);
}

SlideState PipeSolver::slide_state(int j) const {
  return {ground_.row(j),  now_.change.row(j), rise_.row(j),
          tangent_.row(j), stir_.row(j),       slid_.row(j)};
}

void PipeSolver::prepare_slide(int j, float stir_per_discharge) {
  float* rise = rise_.row(j);
  float* tangent = tangent_.row(j);
  float* stir = stir_.row(j);
  const float* ground = ground_.row(j);
  const Grains* change = now_.change.row(j);
  if (start_.material) {
    start_.material(j, {ground, change, ease_.row(j), rise, tangent});
  } else {
    const float steepest = std::tan(radians(parameters_.bank_angle));
    for (int i = 0; i < width_; ++i) {
      rise[i] = (ground[i] + metres_per_grain * static_cast<float>(change[i])) / steepest;
      tangent[i] = steepest;
    }
  }
  sediment_discharge(now_.depth.row(j), now_.sediment.row(j), now_.west.row(j), now_.south.row(j),
                     now_.south.row(j + 1), stir, width_);
  for (int i = 0; i < width_; ++i) stir[i] = 0.5F * stir_per_discharge * stir[i];
  rise_.fill_sides(j, periodic_);
  tangent_.fill_sides(j, periodic_);
  stir_.fill_sides(j, periodic_);
}

void PipeSolver::let_slide(double seconds, Progress& progress) {
  const double cell = start_.ground.cell;
  const auto stir =
      static_cast<float>(static_cast<double>(parameters_.stirring) * seconds / (cell * cell));
  parallel_for(
      0, height_,
      [&](int j) {
        progress.advance(0);
        prepare_slide(j, stir);
      },
      16);
  rise_.fill_ends(periodic_);
  tangent_.fill_ends(periodic_);
  stir_.fill_ends(periodic_);
  std::vector<std::int64_t> moved(static_cast<std::size_t>(height_));
  parallel_for(
      0, height_,
      [&](int j) {
        progress.advance(0);
        moved[static_cast<std::size_t>(j)] =
            slide(slide_state(j - 1), slide_state(j), slide_state(j + 1), next_.change.row(j),
                  width_, {static_cast<float>(cell), !start_.material});
        next_.change.fill_sides(j, periodic_);
      },
      16);
  for (const std::int64_t m : moved) sums_.taken_up += m;
  std::swap(now_.change, next_.change);
  now_.change.fill_ends(periodic_);
  slid_ = now_.change;
}

}  // namespace wold::pipes_detail
