#include "mesh/edit_gltf.hpp"

#include <fmt/format.h>

#include <cmath>
#include <glm/matrix.hpp>
#include <map>
#include <utility>

#include "mesh/gltf_document.hpp"

namespace wold::mesh_edit {

namespace {

class LayoutBuilder {
 public:
  explicit LayoutBuilder(const GltfModel& model) : model_(model) {}

  GltfLayout build() {
    model_.visit_meshes([&](int node, const DMat4& transform) { add_node(node, transform); });
    return std::move(layout_);
  }

 private:
  void add_node(int node, const DMat4& transform) {
    position_blocks_.clear();
    normal_blocks_.clear();
    const int mesh = model_->nodes[static_cast<std::size_t>(node)].mesh;
    const auto& primitives = model_->meshes[static_cast<std::size_t>(mesh)].primitives;
    for (std::size_t k = 0; k < primitives.size(); ++k) {
      const int accessor = model_.positions_of(primitives[k]);
      if (accessor < 0) continue;
      GltfUse use{node, mesh, k, position_block(accessor, transform), -1};
      if (const auto normal = primitives[k].attributes.find("NORMAL");
          normal != primitives[k].attributes.end())
        use.normals = normal_block(normal->second, use.positions, transform);
      layout_.uses.push_back(use);
    }
  }

  std::size_t position_block(int accessor, const DMat4& transform) {
    const auto [place, is_new] = position_blocks_.emplace(accessor, layout_.positions.size());
    if (is_new) {
      const std::size_t count = model_.numbers(accessor, TINYGLTF_TYPE_VEC3).count();
      layout_.positions.push_back({accessor, transform, position_count_, count, 0});
      position_count_ += count;
    }
    return place->second;
  }

  int normal_block(int accessor, std::size_t positions, const DMat4& transform) {
    const GltfBlock& block = layout_.positions[positions];
    const std::size_t count = model_.numbers(accessor, TINYGLTF_TYPE_VEC3).count();
    if (count != block.count)
      model_.fail(fmt::format("a primitive has {} positions, but {} normals", block.count, count));
    const auto [place, is_new] = normal_blocks_.emplace(std::pair(accessor, positions),
                                                        static_cast<int>(layout_.normals.size()));
    if (is_new) {
      layout_.normals.push_back({accessor, transform, point_count_, count, block.first});
      point_count_ += count;
    }
    return place->second;
  }

  const GltfModel& model_;
  GltfLayout layout_;
  std::size_t position_count_ = 0;
  std::size_t point_count_ = 0;
  // Of the node in work.
  std::map<int, std::size_t> position_blocks_;
  std::map<std::pair<int, std::size_t>, int> normal_blocks_;
};

void add_positions(const GltfModel& model, const GltfBlock& block, Content& content) {
  const GltfNumbers numbers = model.numbers(block.accessor, TINYGLTF_TYPE_VEC3);
  for (std::size_t k = 0; k < block.count; ++k)
    content.positions.emplace_back(block.transform * glm::dvec4(vector_at(numbers, k), 1));
}

void add_points(const GltfModel& model, const GltfBlock& block, Content& content) {
  const GltfNumbers numbers = model.numbers(block.accessor, TINYGLTF_TYPE_VEC3);
  const DMat3 turn = glm::transpose(glm::inverse(DMat3(block.transform)));
  for (std::size_t k = 0; k < block.count; ++k) {
    const DVec3 n = turn * vector_at(numbers, k);
    const double length = glm::length(n);
    content.points.push_back(
        {static_cast<std::uint32_t>(block.positions + k), length > 0 ? Vec3(n / length) : Vec3(0)});
  }
}

}  // namespace

GltfLayout layout_of(const GltfModel& model) {
  return LayoutBuilder(model).build();
}

Content gltf_content(std::string_view bytes, const std::string& file) {
  const GltfModel model(bytes, file);
  const GltfDocument writable(bytes, model);  // refuses now what could not be written later
  const GltfLayout layout = layout_of(model);
  Content content;
  for (const GltfBlock& block : layout.positions) add_positions(model, block, content);
  for (const GltfBlock& block : layout.normals) add_points(model, block, content);
  for (const GltfUse& use : layout.uses) {
    const auto& mesh = model->meshes[static_cast<std::size_t>(use.mesh)];
    const GltfBlock& block = layout.positions[use.positions];
    const bool mirrored = glm::determinant(DMat3(block.transform)) < 0;
    for (UVec3 t : model.triangles(mesh.primitives[use.primitive], block.count)) {
      if (mirrored) std::swap(t.y, t.z);
      content.triangles.push_back(t + static_cast<std::uint32_t>(block.first));
      if (layout.normals.empty()) continue;
      const bool smooth = use.normals >= 0;
      const std::size_t first =
          smooth ? layout.normals[static_cast<std::size_t>(use.normals)].first : 0;
      content.triangle_points.push_back(smooth ? t + static_cast<std::uint32_t>(first)
                                               : UVec3(no_point));
    }
  }
  return content;
}

}  // namespace wold::mesh_edit
