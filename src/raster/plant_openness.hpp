#pragma once
// How much of the sky's and the sun's light reaches a place within a crown, averaged over its
// leaves: without it a tree lit by shadow maps alone, or a far one without them, looks flat.
//
// Leaves in a cell of volume V are taken as a turbid medium (Ross, "The radiation regime and
// architecture of plant stands", 1981) of extinction G Ω A / V, A their area, G = 1/2 the mean
// projection of leaves that look everywhere, Ω < 1 their clumping. The light let through from
// direction ω, T(ω) = exp(-∫ extinction), is kept as its mean and first moment:
//   T(ω) ≈ mean + moment · ω.

#include <vector>

#include "base/mesh.hpp"

namespace wold {

class PlantOpenness {
 public:
  /// `sheet[p]`: whether part p is of leaves; of solid parts half the surface counts.
  PlantOpenness(const TriangleMesh& mesh, const std::vector<bool>& sheet);

  /// Moment in x, y, z, mean in w, at a place of the model.
  Vec4 at(Vec3 place) const;
  /// Extinction by others around a leaf of this area (m²) as the mean over leaves, 1/m.
  float mean_extinction(float leaf_area) const;

 private:
  float extinction(Vec3 place) const;
  Vec4 gather(Vec3 place) const;
  std::size_t cell(int i, int j, int k) const;

  Vec3 low_{0};
  Vec3 cell_size_{1};
  int nx_ = 1;
  int ny_ = 1;
  int nz_ = 1;
  std::vector<float> extinction_;  // 1/m
  std::vector<Vec4> light_;
};

}  // namespace wold
