#pragma once
// Triangles seen from above: what `MeshProjection` draws into its samples and asks for heights.

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/vec.hpp"

namespace wold {

/// An interval of x, m.
struct Span {
  double low = 0;
  double high = 0;
};

/// A triangle of the world, m, with an area in plan.
class PlanTriangle {
 public:
  /// Nothing for a triangle that from above is a line or a point, for less than `thinnest` m².
  static std::optional<PlanTriangle> from(const DVec3& a, const DVec3& b, const DVec3& c,
                                          double thinnest);

  DVec2 low() const { return glm::min(DVec2(p_[0]), glm::min(DVec2(p_[1]), DVec2(p_[2]))); }
  DVec2 high() const { return glm::max(DVec2(p_[0]), glm::max(DVec2(p_[1]), DVec2(p_[2]))); }

  /// What of it lies between two lines of equal y.
  std::optional<Span> between(double y0, double y1) const;

  /// Its plane's height, held within the heights of its corners.
  double height_at(DVec2 place) const {
    const double z = p_[0].z + glm::dot(gradient_, place - DVec2(p_[0]));
    return std::clamp(z, low_z_, high_z_);
  }

 private:
  DVec3 p_[3]{};
  DVec2 gradient_{0};
  double low_z_ = 0;
  double high_z_ = 0;
};

/// Finds the highest triangle over a place: triangles sorted into square bins.
class TriangleBins {
 public:
  /// `triangles` must outlive this.
  explicit TriangleBins(std::span<const PlanTriangle> triangles);

  /// The greatest height of the triangles over a place, or within `reach` m of it.
  std::optional<double> highest(DVec2 place, double reach) const;

 private:
  int column(double x) const;
  int row(double y) const;
  template <class Visit>
  void visit_bins(const PlanTriangle& triangle, const Visit& visit) const;

  std::span<const PlanTriangle> triangles_;
  DVec2 origin_{0};
  double side_ = 1;
  int columns_ = 1;
  int rows_ = 1;
  std::vector<std::uint32_t> first_;  // per bin, in `sorted_`
  std::vector<std::uint32_t> sorted_;
};

}  // namespace wold
