#include "raster/plant_openness.hpp"

#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "mesh/parts.hpp"
#include "raster/plant_shape.hpp"

namespace wold {

namespace {

constexpr int cells_across = 20;    // along the longest side
constexpr float projection = 0.5F;  // G
constexpr float clumping = 0.9F;    // Ω, within cells; that of crowns and branches they have
constexpr int directions = 32;

/// Even over the sphere (a Fibonacci lattice).
Vec3 direction(int k) {
  const float z = 1 - (2 * static_cast<float>(k) + 1) / static_cast<float>(directions);
  const float angle = 2.399963F * static_cast<float>(k);
  const float r = std::sqrt(1 - z * z);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

}  // namespace

PlantOpenness::PlantOpenness(const TriangleMesh& mesh, const std::vector<bool>& sheet) {
  const auto [low, high] = mesh.bounds();
  const Vec3 size = glm::max(high - low, Vec3(1e-3F));
  const float step = std::max({size.x, size.y, size.z}) / cells_across;
  const auto count = [step](float length) {
    return std::clamp(static_cast<int>(std::ceil(length / step)), 1, cells_across);
  };
  nx_ = count(size.x);
  ny_ = count(size.y);
  nz_ = count(size.z);
  low_ = low;
  cell_size_ =
      size / Vec3(static_cast<float>(nx_), static_cast<float>(ny_), static_cast<float>(nz_));
  extinction_.assign(static_cast<std::size_t>(nx_) * ny_ * nz_, 0.0F);
  const float volume = cell_size_.x * cell_size_.y * cell_size_.z;
  const std::vector<MeshPart> parts = all_parts(mesh);
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const float share = projection * clumping / volume * (sheet[p] ? 1.0F : 0.5F);
    const std::uint32_t end = parts[p].first_triangle + parts[p].triangle_count;
    for (std::uint32_t t = parts[p].first_triangle; t < end; ++t) {
      const UVec3& c = mesh.triangles[t];
      const Vec3 middle = (mesh.positions[c.x] + mesh.positions[c.y] + mesh.positions[c.z]) / 3.0F;
      const Vec3 at = (middle - low_) / cell_size_;
      extinction_[cell(static_cast<int>(at.x), static_cast<int>(at.y), static_cast<int>(at.z))] +=
          share * triangle_area(mesh, t);
    }
  }
  light_.resize(extinction_.size());
  parallel_for(0, nz_, [&](int k) {
    for (int j = 0; j < ny_; ++j)
      for (int i = 0; i < nx_; ++i) {
        const Vec3 middle(static_cast<float>(i) + 0.5F, static_cast<float>(j) + 0.5F,
                          static_cast<float>(k) + 0.5F);
        light_[cell(i, j, k)] = gather(low_ + middle * cell_size_);
      }
  });
}

std::size_t PlantOpenness::cell(int i, int j, int k) const {
  i = std::clamp(i, 0, nx_ - 1);
  j = std::clamp(j, 0, ny_ - 1);
  k = std::clamp(k, 0, nz_ - 1);
  return (static_cast<std::size_t>(k) * ny_ + j) * nx_ + i;
}

float PlantOpenness::extinction(Vec3 place) const {
  const Vec3 at = (place - low_) / cell_size_;
  if (at.x < 0 || at.y < 0 || at.z < 0 || at.x >= static_cast<float>(nx_) ||
      at.y >= static_cast<float>(ny_) || at.z >= static_cast<float>(nz_))
    return 0;
  return extinction_[cell(static_cast<int>(at.x), static_cast<int>(at.y), static_cast<int>(at.z))];
}

float PlantOpenness::mean_extinction(float leaf_area) const {
  const float volume = cell_size_.x * cell_size_.y * cell_size_.z;
  // A leaf does not shade itself; of a large one a part lies in the cell.
  const float own =
      projection * clumping / volume * std::min(leaf_area, std::pow(volume, 2.0F / 3.0F));
  double sum = 0;
  double others = 0;
  // Leaf area of a cell goes as its extinction.
  for (const float e : extinction_) {
    sum += static_cast<double>(e);
    others += static_cast<double>(e * std::max(e - own, 0.0F));
  }
  return sum > 0 ? static_cast<float>(others / sum) : 0.0F;
}

Vec4 PlantOpenness::gather(Vec3 place) const {
  const float step = 0.8F * std::min({cell_size_.x, cell_size_.y, cell_size_.z});
  Vec4 sum(0);
  for (int d = 0; d < directions; ++d) {
    const Vec3 towards = direction(d);
    float depth = 0;
    for (int s = 0; s < 2 * cells_across; ++s)
      depth += step * extinction(place + (static_cast<float>(s) + 0.5F) * step * towards);
    const float through = std::exp(-depth);
    sum += Vec4(3.0F * through * towards, through);
  }
  return sum / static_cast<float>(directions);
}

Vec4 PlantOpenness::at(Vec3 place) const {
  const Vec3 p = (place - low_) / cell_size_ - Vec3(0.5F);
  const Vec3 base = glm::floor(p);
  const Vec3 f = p - base;
  const auto i = static_cast<int>(base.x);
  const auto j = static_cast<int>(base.y);
  const auto k = static_cast<int>(base.z);
  Vec4 sum(0);
  for (int corner = 0; corner < 8; ++corner) {
    const int dx = corner & 1;
    const int dy = (corner >> 1) & 1;
    const int dz = corner >> 2;
    const float w =
        (dx != 0 ? f.x : 1 - f.x) * (dy != 0 ? f.y : 1 - f.y) * (dz != 0 ? f.z : 1 - f.z);
    sum += w * light_[cell(i + dx, j + dy, k + dz)];
  }
  return sum;
}

}  // namespace wold
