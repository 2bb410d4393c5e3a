#pragma once
// Everything that is rendered, as data: ground, models of plants, where they stand, materials and
// sky.

#include <cstdint>
#include <string>
#include <vector>

#include "base/mesh.hpp"
#include "render/ground.hpp"
#include "render/material.hpp"
#include "sky/sky.hpp"

namespace wold {

/// A mesh that many instances share. `part_materials[k]` is the index, in World::materials, of
/// mesh.parts[k].
struct Model {
  TriangleMesh mesh;
  std::vector<std::uint32_t> part_materials;
};

/// A model set in the world: turned about its own z by `yaw`, its z brought to `up`, scaled, moved.
struct ModelInstance {
  Vec3 position{0};
  Vec3 up{0, 0, 1};  ///< unit
  float yaw = 0;     ///< radians
  float scale = 1;
  std::uint32_t model = 0;
  std::uint32_t individual = 0;  ///< seeds its tint; stable for the same plant
};

struct World {
  Ground ground;
  std::vector<SurfaceMaterial> materials;
  std::vector<Model> models;
  std::vector<ModelInstance> instances;
  Sky sky;
};

}  // namespace wold
