#pragma once
// Where the vertices of a mesh to be edited stand in its glTF file.

#include <string>
#include <string_view>
#include <vector>

#include "mesh/edit.hpp"
#include "mesh/gltf_model.hpp"

namespace wold::mesh_edit {

/// The vertices of one accessor as one node shows them.
struct GltfBlock {
  int accessor = 0;
  DMat4 transform{1};     ///< of the node, to the world
  std::size_t first = 0;  ///< of its positions, or of its points
  std::size_t count = 0;
  std::size_t positions = 0;  ///< for normals: the first of the positions that they belong to
};

/// One primitive in one node.
struct GltfUse {
  int node = 0;
  int mesh = 0;
  std::size_t primitive = 0;
  std::size_t positions = 0;  ///< index of a block
  int normals = -1;           ///< index of a block, or -1
};

/// All primitives of the scene with their blocks: each accessor is there once for each node that
/// shows it, with normals once for each accessor of positions.
struct GltfLayout {
  std::vector<GltfBlock> positions;
  std::vector<GltfBlock> normals;
  std::vector<GltfUse> uses;
};

GltfLayout layout_of(const GltfModel& model);

inline DVec3 vector_at(const GltfNumbers& numbers, std::size_t k) {
  return {numbers(k, 0), numbers(k, 1), numbers(k, 2)};
}

}  // namespace wold::mesh_edit
