#include "terrain/mesh_field.hpp"

#include <fmt/format.h>

#include <atomic>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "base/memory.hpp"
#include "base/parallel.hpp"
#include "terrain/mesh_raster.hpp"

namespace wold {

namespace {

constexpr float nothing = -std::numeric_limits<float>::infinity();

[[noreturn]] void fail(const std::string& message) {
  throw Error(ErrorKind::input, "cannot project the mesh: " + message);
}

/// Calls `work(k)` for k below `count`, on many threads; a stage of the progress.
template <class Work>
void for_each(const char* name, const char* unit, std::size_t count, Progress& progress,
              const Work& work) {
  const ProgressStage stage(progress, name, static_cast<double>(count), unit);
  constexpr std::size_t chunk = 4096;
  parallel_for(0, static_cast<int>((count + chunk - 1) / chunk), [&](int c) {
    const std::size_t first = static_cast<std::size_t>(c) * chunk;
    for (std::size_t k = first; k < std::min(count, first + chunk); ++k) work(k);
    progress.advance(chunk);
  });
}

void check_mesh(std::span<const DVec3> positions, std::span<const UVec3> triangles) {
  if (triangles.empty()) fail("it has no faces");
  for (std::size_t k = 0; k < positions.size(); ++k)
    if (!std::isfinite(positions[k].x) || !std::isfinite(positions[k].y) ||
        !std::isfinite(positions[k].z))
      fail(fmt::format("the position of vertex {} (counted from 0) is not finite", k));
  for (const UVec3& t : triangles)
    if (t.x >= positions.size() || t.y >= positions.size() || t.z >= positions.size())
      throw Error(ErrorKind::internal, "a triangle to be projected has no such vertex");
}

void check_settings(const ProjectionSettings& s) {
  const auto check = [](const char* name, double value, bool zero) {
    if (!std::isfinite(value) || value < 0 || (value == 0 && !zero))
      fail(fmt::format("'{}' is {}; {} is allowed", name, value,
                       zero ? "0 or a number above it" : "a number above 0"));
  };
  check("cell", s.cell, true);
  check("scale", s.scale, false);
  check("tolerance", s.tolerance, true);
  if (s.resolution != 0 && s.resolution < 2)
    fail(fmt::format("'resolution' is {}; 2 or more samples are allowed, or 0", s.resolution));
}

/// The smallest rectangle in plan around all triangles.
struct PlanBounds {
  DVec2 low{std::numeric_limits<double>::infinity()};
  DVec2 high{-std::numeric_limits<double>::infinity()};

  void add(DVec2 p) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
};

PlanBounds bounds_of(std::span<const DVec3> positions, std::span<const UVec3> triangles) {
  PlanBounds b;
  for (const UVec3& t : triangles)
    for (int c = 0; c < 3; ++c) b.add(DVec2(positions[t[c]]));
  return b;
}

/// Cells along an extent: a hair more than a whole number is that number.
double cells_along(double extent, double cell) {
  return std::max(1.0, std::ceil(extent / cell - 1e-3));
}

/// The empty field for these bounds, m.
Heightfield field_for(const PlanBounds& bounds, double cell) {
  const double columns = cells_along(bounds.high.x - bounds.low.x, cell) + 1;
  const double rows = cells_along(bounds.high.y - bounds.low.y, cell) + 1;
  constexpr double most = 100'000;
  constexpr double bytes_per_sample = 20;
  const double bytes = columns * rows * bytes_per_sample;
  const auto available = static_cast<double>(available_memory());
  if (columns > most || rows > most || (available > 0 && bytes > 0.9 * available))
    throw Error(ErrorKind::limit,
                fmt::format("to project the mesh onto {:.0f} x {:.0f} samples, {:.6g} m apart, "
                            "needs {}; {} are free and {:.0f} samples along a side the most. "
                            "Choose a larger cell or fewer samples.",
                            columns, rows, cell, memory_text(bytes), memory_text(available), most));
  return {Grid<float>(static_cast<int>(columns), static_cast<int>(rows), nothing), bounds.low,
          cell};
}

void raise(float& at, float value) {
  std::atomic_ref<float> cell(at);
  float before = cell.load(std::memory_order_relaxed);
  while (value > before && !cell.compare_exchange_weak(before, value, std::memory_order_relaxed)) {
  }
}

/// Raises the samples that a triangle covers. The highest of all is the same in any order.
void draw(const PlanTriangle& triangle, Heightfield& field) {
  const double reach = 1e-3;  // cells: borders of neighbours may have gaps of rounding
  const auto first = [&](double x, int count) {
    return static_cast<int>(std::clamp(std::ceil(x - reach), 0.0, static_cast<double>(count)));
  };
  const auto last = [&](double x, int count) {
    return static_cast<int>(
        std::clamp(std::floor(x + reach), -1.0, static_cast<double>(count - 1)));
  };
  const auto in_cells = [&](double x, double origin) { return (x - origin) / field.cell; };
  const int width = field.height.width();
  const int height = field.height.height();
  const auto draw_row = [&](int j) {
    const double y = field.origin.y + field.cell * j;
    const auto span = triangle.between(y - reach * field.cell, y + reach * field.cell);
    if (!span) return;
    const std::span<float> row = field.height.row(j);
    const int end = last(in_cells(span->high, field.origin.x), width);
    for (int i = first(in_cells(span->low, field.origin.x), width); i <= end; ++i)
      raise(row[static_cast<std::size_t>(i)],
            static_cast<float>(triangle.height_at({field.origin.x + field.cell * i, y})));
  };
  const int south = first(in_cells(triangle.low().y, field.origin.y), height);
  const int north = last(in_cells(triangle.high().y, field.origin.y), height);
  constexpr int many_rows = 256;
  if (north - south < many_rows)
    for (int j = south; j <= north; ++j) draw_row(j);
  else
    parallel_for(south, north + 1, draw_row, 16);
}

std::vector<PlanTriangle> plan_triangles(std::span<const DVec3> positions,
                                         std::span<const UVec3> triangles, double scale,
                                         double thinnest) {
  std::vector<PlanTriangle> result;
  result.reserve(triangles.size());
  for (const UVec3& t : triangles)
    if (const auto plan = PlanTriangle::from(scale * positions[t.x], scale * positions[t.y],
                                             scale * positions[t.z], thinnest))
      result.push_back(*plan);
  return result;
}

double cell_for(const ProjectionSettings& settings, double longest, double spacing) {
  if (settings.cell > 0) return settings.cell;
  if (settings.resolution > 0) return longest / (settings.resolution - 1);
  const double cells = spacing > 0 ? std::round(longest / spacing) : 1;
  return longest / std::clamp(cells, 1.0, static_cast<double>(most_projected_samples - 1));
}

}  // namespace

double spacing_in_plan(std::span<const DVec3> positions, std::span<const UVec3> triangles) {
  constexpr std::size_t most = 2'000'000;  // triangles looked at
  const std::size_t step = 1 + triangles.size() / most;
  std::vector<double> lengths;
  for (std::size_t k = 0; k < triangles.size(); k += step) {
    const UVec3& t = triangles[k];
    const DVec2 p[3]{positions[t.x], positions[t.y], positions[t.z]};
    const DVec2 a = p[1] - p[0];
    const DVec2 b = p[2] - p[0];
    const double longest = std::max(glm::dot(a, a), glm::dot(b, b));
    if (std::abs(a.x * b.y - a.y * b.x) <= 1e-6 * longest) continue;  // stands upright
    for (int c = 0; c < 3; ++c) lengths.push_back(glm::distance(p[c], p[(c + 1) % 3]));
  }
  if (lengths.empty()) return 0;
  const auto quartile = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 4);
  std::nth_element(lengths.begin(), quartile, lengths.end());
  return *quartile;
}

MeshProjection::MeshProjection(std::span<const DVec3> positions, std::span<const UVec3> triangles,
                               const ProjectionSettings& settings, Progress& progress)
    : scale_(settings.scale) {
  check_settings(settings);
  check_mesh(positions, triangles);
  PlanBounds bounds = bounds_of(positions, triangles);
  bounds.low *= scale_;
  bounds.high *= scale_;
  const DVec2 extent = bounds.high - bounds.low;
  const double longest = std::max(extent.x, extent.y);
  if (!(std::min(extent.x, extent.y) > 1e-9 * longest) || !std::isfinite(longest))
    fail(
        fmt::format("seen from above it measures {:.6g} m x {:.6g} m; both must be above 0 (is "
                    "its upward axis right?)",
                    extent.x, extent.y));
  field_ = field_for(bounds,
                     cell_for(settings, longest, scale_ * spacing_in_plan(positions, triangles)));
  const std::vector<PlanTriangle> plan =
      plan_triangles(positions, triangles, scale_, 1e-14 * longest * longest);
  if (plan.empty())
    fail(
        "all its faces stand upright, so that from above there is no ground (is its upward axis "
        "right?)");
  for_each("projecting the mesh", "triangles", plan.size(), progress,
           [&](std::size_t k) { draw(plan[k], field_); });
  covered_ = Grid<std::uint8_t>(field_.height.width(), field_.height.height(), 0);
  for (std::size_t k = 0; k < covered_.size(); ++k)
    covered_.values()[k] = field_.height.values()[k] > nothing ? 1 : 0;
  fill_uncovered(field_.height, covered_, progress);
  const TriangleBins bins(plan);
  const double tolerance = settings.tolerance > 0 ? settings.tolerance : 0.1 * field_.cell;
  on_surface_.resize(positions.size());
  for_each("finding its surface", "vertices", positions.size(), progress, [&](std::size_t k) {
    const DVec3 p = scale_ * positions[k];
    const auto highest = bins.highest(DVec2(p), 1e-6 * field_.cell);
    on_surface_[k] = highest && std::abs(p.z - *highest) <= tolerance ? 1 : 0;
  });
}

std::size_t MeshProjection::displace(std::span<DVec3> positions, const Heightfield& after) const {
  if (!after.height.same_shape(field_.height) || positions.size() != on_surface_.size())
    throw Error(ErrorKind::internal, "what is carried back to a mesh is not what was projected");
  Heightfield difference = field_;
  for (std::size_t k = 0; k < difference.height.size(); ++k) {
    float& d = difference.height.values()[k];
    d = after.height.values()[k] - d;
    if (!std::isfinite(d)) fail("the new ground has heights that are not finite");
  }
  const auto count = static_cast<int>(positions.size());
  constexpr int grain = 4096;
  parallel_for(
      0, count,
      [&](int k) {
        DVec3& p = positions[static_cast<std::size_t>(k)];
        if (on_surface_[static_cast<std::size_t>(k)] != 0)
          p.z += static_cast<double>(height_at(difference, scale_ * DVec2(p))) / scale_;
      },
      grain);
  return static_cast<std::size_t>(std::count(on_surface_.begin(), on_surface_.end(), 1));
}

}  // namespace wold
