#include "terrain/resample.hpp"

#include <algorithm>
#include <cmath>

#include "terrain/field_map.hpp"

namespace wold {

namespace {

double mirrored(double x, double length) {
  if (length <= 0) return 0;
  const double t = std::abs(std::remainder(x, 2 * length));
  return std::min(t, length);
}

/// Binomial smoothing [1 2 1]/4 along both axes with samples `step` apart: repeated with steps 1,
/// 2, 4, … it is the pyramid of Burt and Adelson (1983) without leaving samples out.
Grid<float> smoothed(const Grid<float>& in, int step, Progress& progress) {
  const auto filter = [](float before, float at, float after) {
    return 0.25F * (before + after) + 0.5F * at;
  };
  const Heightfield shape{in, {}, 1};
  const Grid<float> along_x = map_grid<float>(shape, progress, [&](int i, int j) {
    return filter(in.clamped(i - step, j), in(i, j), in.clamped(i + step, j));
  });
  return map_grid<float>(shape, progress, [&](int i, int j) {
    return filter(along_x.clamped(i, j - step), along_x(i, j), along_x.clamped(i, j + step));
  });
}

}  // namespace

Grid<float> resample(const Grid<float>& source, const TerrainDomain& place, Outside outside,
                     const Heightfield& like, Progress& progress) {
  const DVec2 intervals(std::max(1, source.width() - 1), std::max(1, source.height() - 1));
  const DVec2 per_metre = intervals / place.size;
  Heightfield field{source, {}, 1};
  const double coarser = like.cell * std::min(per_metre.x, per_metre.y);
  for (int step = 1; 2 * step <= coarser; step *= 2)
    field.height = smoothed(field.height, step, progress);
  return map_grid<float>(like, progress, [&](int i, int j) {
    DVec2 p = (place_of(like, i, j) - place.origin) * per_metre;
    if (outside == Outside::mirror) p = {mirrored(p.x, intervals.x), mirrored(p.y, intervals.y)};
    return ground_at(field, p).height;
  });
}

}  // namespace wold
