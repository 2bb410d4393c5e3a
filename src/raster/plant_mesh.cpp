#include "raster/plant_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/packing.hpp>

namespace wold {

namespace {

/// ∫ f^power dr over [0, 1].
float kept(float share, float power) {
  const float fade = plant_fade * share;
  const float cut = std::clamp((share + fade - 1) / fade, 0.0F, 1.0F);
  return share + fade / (power + 1) * (1 - std::pow(cut, power + 1));
}

}  // namespace

float leaf_growth(float share) {
  return 1 / kept(share, 2);
}

float strip_growth(float share) {
  return 1 / kept(share, 1);
}

TriangleMesh plant_mesh_at(const PlantLevels& levels, bool is_fine, float share) {
  const PlantLevel& level = levels.level(is_fine, share);
  TriangleMesh mesh;
  const auto half = [](std::uint16_t h) { return glm::unpackHalf1x16(h); };
  for (const PlantVertex& v : levels.vertices) {
    const float aspect = half(v.across[3]);
    const float rank = half(v.along[3]);
    Vec3 p = v.position;
    if (aspect != aspect_fixed) {
      const float f =
          std::clamp((share * (1 + plant_fade) - rank) / (plant_fade * share), 0.0F, 1.0F);
      const bool strip = aspect >= 0.5F * aspect_strip;
      const float growth = strip ? strip_growth(share) : leaf_growth(share);
      const float both = std::sqrt(std::max(1.0F, growth / aspect));
      const float wide = std::min(growth, aspect) * both;
      p += (f * wide - 1) * Vec3(half(v.across[0]), half(v.across[1]), half(v.across[2]));
      p += (f * both - 1) * Vec3(half(v.along[0]), half(v.along[1]), half(v.along[2]));
    }
    mesh.positions.push_back(p);
    mesh.normals.push_back(glm::normalize(Vec3(v.normal[0], v.normal[1], v.normal[2])));
  }
  for (std::uint32_t slot = 0; slot < levels.materials.size(); ++slot) {
    const auto first = static_cast<std::uint32_t>(mesh.triangles.size());
    for (std::uint32_t k = 0; k + 2 < level.index_count; k += 3) {
      const std::uint32_t* i = &levels.indices[level.first_index + k];
      if (levels.vertices[i[2]].identity >> 24U == slot)
        mesh.triangles.emplace_back(i[0], i[1], i[2]);
    }
    mesh.parts.push_back({{}, first, static_cast<std::uint32_t>(mesh.triangles.size()) - first});
  }
  return mesh;
}

}  // namespace wold
