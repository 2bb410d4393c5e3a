#include <fmt/format.h>

#include <algorithm>
#include <glm/matrix.hpp>
#include <map>
#include <set>

#include "base/error.hpp"
#include "mesh/edit_gltf.hpp"
#include "mesh/gltf_document.hpp"

namespace wold::mesh_edit {

namespace {

class GltfWriter {
 public:
  GltfWriter(std::string_view bytes, const std::string& file, const Edit& edit)
      : edit_(edit), model_(bytes, file), layout_(layout_of(model_)), document_(bytes, model_) {}

  std::string write() {
    for (const GltfBlock& block : layout_.positions)
      if (moved(block)) changed_.insert(block.accessor);
    for (const GltfBlock& block : layout_.normals)
      if (turned(block)) changed_.insert(block.accessor);
    for (const GltfBlock& block : layout_.positions)
      position_accessors_.push_back(write_positions(block));
    for (const GltfBlock& block : layout_.normals)
      normal_accessors_.push_back(write_normals(block));
    for (const GltfUse& use : layout_.uses) point_to_accessors(use);
    return document_.bytes();
  }

 private:
  bool moved(const GltfBlock& block) const {
    for (std::size_t k = 0; k < block.count; ++k)
      if (edit_.moved(block.first + k)) return true;
    return false;
  }
  bool turned(const GltfBlock& block) const {
    const auto begin = edit_.turned.begin() + static_cast<std::ptrdiff_t>(block.first);
    return std::find(begin, begin + static_cast<std::ptrdiff_t>(block.count), 1) !=
           begin + static_cast<std::ptrdiff_t>(block.count);
  }

  /// The accessor that holds these values afterwards: the block's own for the first block that has
  /// it, if it can hold floats; else a new one.
  int store(const GltfBlock& block, const std::vector<Vec3>& values) {
    const auto& accessor = model_->accessors[static_cast<std::size_t>(block.accessor)];
    const bool in_place = accessor.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT &&
                          stored_.insert(block.accessor).second;
    if (!in_place) return document_.add(values);
    for (std::size_t k = 0; k < values.size(); ++k) document_.set(block.accessor, k, values[k]);
    return block.accessor;
  }

  int write_positions(const GltfBlock& block) {
    if (changed_.count(block.accessor) == 0) return block.accessor;
    if (moved(block) && glm::determinant(DMat3(block.transform)) == 0)
      model_.fail("a node is scaled to nothing");
    const GltfNumbers numbers = model_.numbers(block.accessor, TINYGLTF_TYPE_VEC3);
    const DMat4 to_node = glm::inverse(block.transform);
    std::vector<Vec3> values;
    for (std::size_t k = 0; k < block.count; ++k)
      values.emplace_back(edit_.moved(block.first + k)
                              ? DVec3(to_node * glm::dvec4(edit_.positions[block.first + k], 1))
                              : vector_at(numbers, k));
    const int accessor = store(block, values);
    document_.set_bounds(accessor, values);
    return accessor;
  }

  int write_normals(const GltfBlock& block) {
    if (changed_.count(block.accessor) == 0) return block.accessor;
    const GltfNumbers numbers = model_.numbers(block.accessor, TINYGLTF_TYPE_VEC3);
    const DMat3 to_node = glm::transpose(DMat3(block.transform));
    std::vector<Vec3> values;
    for (std::size_t k = 0; k < block.count; ++k)
      values.emplace_back(edit_.turned[block.first + k] != 0
                              ? glm::normalize(to_node * DVec3(edit_.normals[block.first + k]))
                              : vector_at(numbers, k));
    return store(block, values);
  }

  /// Makes a primitive use the accessors of its blocks; where several nodes show a mesh that
  /// changed, the second and further get one of their own.
  void point_to_accessors(const GltfUse& use) {
    const int position = position_accessors_[use.positions];
    const int normal =
        use.normals < 0 ? -1 : normal_accessors_[static_cast<std::size_t>(use.normals)];
    const bool same = position == layout_.positions[use.positions].accessor &&
                      (use.normals < 0 ||
                       normal == layout_.normals[static_cast<std::size_t>(use.normals)].accessor);
    if (same) return;
    auto& primitives =
        document_.json()["meshes"][static_cast<std::size_t>(mesh_of(use))]["primitives"];
    auto& attributes = primitives[use.primitive]["attributes"];
    attributes["POSITION"] = position;
    if (normal >= 0) attributes["NORMAL"] = normal;
  }

  int mesh_of(const GltfUse& use) {
    const auto own = mesh_of_node_.find(use.node);
    if (own != mesh_of_node_.end()) return own->second;
    auto& json = document_.json();
    int mesh = use.mesh;
    const auto first = std::find_if(layout_.uses.begin(), layout_.uses.end(),
                                    [&](const GltfUse& other) { return other.mesh == use.mesh; });
    if (first->node != use.node) {
      const auto copy =
          original_.emplace(use.mesh, json["meshes"][static_cast<std::size_t>(use.mesh)]);
      json["meshes"].push_back(copy.first->second);
      mesh = static_cast<int>(json["meshes"].size()) - 1;
      json["nodes"][static_cast<std::size_t>(use.node)]["mesh"] = mesh;
    }
    mesh_of_node_.emplace(use.node, mesh);
    return mesh;
  }

  const Edit& edit_;
  GltfModel model_;
  GltfLayout layout_;
  GltfDocument document_;
  std::set<int> changed_;                // accessors
  std::set<int> stored_;                 // accessors that hold their new values
  std::vector<int> position_accessors_;  // of each block
  std::vector<int> normal_accessors_;
  std::map<int, int> mesh_of_node_;
  std::map<int, GltfDocument::Json> original_;
};

}  // namespace

std::string edited_gltf(std::string_view bytes, const std::string& file, const Edit& edit) {
  try {
    return GltfWriter(bytes, file, edit).write();
  } catch (const nlohmann::json::exception& e) {
    throw Error(ErrorKind::input, fmt::format("'{}' is no sound glTF file: {}", file, e.what()));
  }
}

}  // namespace wold::mesh_edit
