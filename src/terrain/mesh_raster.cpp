#include "terrain/mesh_raster.hpp"

#include <cmath>

namespace wold {

std::optional<PlanTriangle> PlanTriangle::from(const DVec3& a, const DVec3& b, const DVec3& c,
                                               double thinnest) {
  const DVec3 normal = glm::cross(b - a, c - a);
  if (!(std::abs(normal.z) > 2 * thinnest)) return std::nullopt;
  PlanTriangle t;
  t.p_[0] = a;
  t.p_[1] = b;
  t.p_[2] = c;
  t.gradient_ = -DVec2(normal) / normal.z;
  t.low_z_ = std::min({a.z, b.z, c.z});
  t.high_z_ = std::max({a.z, b.z, c.z});
  return t;
}

std::optional<Span> PlanTriangle::between(double y0, double y1) const {
  std::optional<Span> span;
  const auto add = [&](double x) {
    span = span ? Span{std::min(span->low, x), std::max(span->high, x)} : Span{x, x};
  };
  for (int k = 0; k < 3; ++k) {
    const DVec3& a = p_[k];
    const DVec3& b = p_[(k + 1) % 3];
    if (a.y >= y0 && a.y <= y1) add(a.x);
    for (const double y : {y0, y1})
      if ((a.y < y) != (b.y < y))
        add(a.x + (b.x - a.x) * std::clamp((y - a.y) / (b.y - a.y), 0.0, 1.0));
  }
  return span;
}

TriangleBins::TriangleBins(std::span<const PlanTriangle> triangles) : triangles_(triangles) {
  if (triangles.empty()) return;
  origin_ = triangles.front().low();
  DVec2 high = triangles.front().high();
  for (const PlanTriangle& t : triangles) {
    origin_ = glm::min(origin_, t.low());
    high = glm::max(high, t.high());
  }
  // About four triangles to a bin, if they are alike.
  const DVec2 extent = high - origin_;
  const double longest = std::max(extent.x, extent.y);
  constexpr double most_bins = 8192;
  side_ = std::max(2 * std::sqrt(extent.x * extent.y / static_cast<double>(triangles.size())),
                   longest / most_bins);
  columns_ = static_cast<int>(extent.x / side_) + 1;
  rows_ = static_cast<int>(extent.y / side_) + 1;
  first_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_) + 1, 0);
  for (const PlanTriangle& t : triangles)
    visit_bins(t, [&](std::size_t bin) { ++first_[bin + 1]; });
  for (std::size_t k = 1; k < first_.size(); ++k) first_[k] += first_[k - 1];
  sorted_.resize(first_.back());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (std::size_t k = 0; k < triangles.size(); ++k)
    visit_bins(triangles[k],
               [&](std::size_t bin) { sorted_[next[bin]++] = static_cast<std::uint32_t>(k); });
}

int TriangleBins::column(double x) const {
  return static_cast<int>(
      std::clamp((x - origin_.x) / side_, 0.0, static_cast<double>(columns_ - 1)));
}

int TriangleBins::row(double y) const {
  return static_cast<int>(std::clamp((y - origin_.y) / side_, 0.0, static_cast<double>(rows_ - 1)));
}

template <class Visit>
void TriangleBins::visit_bins(const PlanTriangle& triangle, const Visit& visit) const {
  // A little wider than the bins, so that a place on their border finds it in either.
  const double margin = 1e-3 * side_;
  const int last = row(triangle.high().y + margin);
  for (int j = row(triangle.low().y - margin); j <= last; ++j) {
    const double south = origin_.y + side_ * j;
    const auto span = triangle.between(south - margin, south + side_ + margin);
    if (!span) continue;
    const int east = column(span->high + margin);
    for (int i = column(span->low - margin); i <= east; ++i)
      visit(static_cast<std::size_t>(j) * static_cast<std::size_t>(columns_) +
            static_cast<std::size_t>(i));
  }
}

std::optional<double> TriangleBins::highest(DVec2 place, double reach) const {
  std::optional<double> highest;
  if (triangles_.empty()) return highest;
  const std::size_t bin =
      static_cast<std::size_t>(row(place.y)) * static_cast<std::size_t>(columns_) +
      static_cast<std::size_t>(column(place.x));
  for (std::uint32_t k = first_[bin]; k < first_[bin + 1]; ++k) {
    const PlanTriangle& t = triangles_[sorted_[k]];
    const auto span = t.between(place.y - reach, place.y + reach);
    if (!span || place.x < span->low - reach || place.x > span->high + reach) continue;
    const double z = t.height_at(place);
    highest = std::max(highest.value_or(z), z);
  }
  return highest;
}

}  // namespace wold
