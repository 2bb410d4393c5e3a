#include <cmath>
#include <glm/matrix.hpp>
#include <map>

#include "mesh/gltf.hpp"
#include "mesh/gltf_model.hpp"
#include "mesh/parts.hpp"

namespace wold {

namespace {

class GltfReader {
 public:
  GltfReader(std::string_view bytes, const std::string& file) : model_(bytes, file) {}

  TriangleMesh read() {
    model_.visit_meshes([&](int node, const DMat4& transform) {
      vertices_.clear();
      const int mesh = model_->nodes[static_cast<std::size_t>(node)].mesh;
      for (const auto& primitive : model_->meshes[static_cast<std::size_t>(mesh)].primitives)
        add(primitive, transform);
    });
    if (!all_normals_) mesh_.normals.clear();
    if (!all_uvs_) mesh_.uvs.clear();
    parts_.finish(mesh_);
    return std::move(mesh_);
  }

 private:
  void add(const tinygltf::Primitive& primitive, const DMat4& transform) {
    const int accessor = model_.positions_of(primitive);
    if (accessor < 0) return;
    const GltfNumbers positions = model_.numbers(accessor, TINYGLTF_TYPE_VEC3);
    const auto [vertices, is_new] =
        vertices_.emplace(primitive.attributes, static_cast<std::uint32_t>(mesh_.positions.size()));
    if (is_new) {
      add_positions(positions, transform);
      add_normals(primitive, glm::transpose(glm::inverse(glm::dmat3(transform))));
      add_uvs(primitive);
    }
    parts_.use_material(primitive.material < 0
                            ? ""
                            : model_.item(model_->materials, primitive.material, "material").name);
    const bool mirrored = glm::determinant(glm::dmat3(transform)) < 0;
    for (const UVec3& t : model_.triangles(primitive, positions.count()))
      parts_.add(vertices->second + (mirrored ? UVec3(t.x, t.z, t.y) : t));
  }

  void add_positions(const GltfNumbers& positions, const DMat4& transform) {
    for (std::size_t k = 0; k < positions.count(); ++k) {
      const glm::dvec4 p(positions(k, 0), positions(k, 1), positions(k, 2), 1);
      mesh_.positions.push_back(z_up(DVec3(transform * p)));
    }
  }

  static Vec3 z_up(DVec3 v) { return Vec3(DVec3(v.x, -v.z, v.y)); }

  void add_normals(const tinygltf::Primitive& primitive, const glm::dmat3& transform) {
    const auto found = primitive.attributes.find("NORMAL");
    if (found != primitive.attributes.end()) {
      const GltfNumbers normals = model_.numbers(found->second, TINYGLTF_TYPE_VEC3);
      for (std::size_t k = 0; k < normals.count(); ++k) {
        const DVec3 n = transform * DVec3(normals(k, 0), normals(k, 1), normals(k, 2));
        const double length = glm::length(n);
        mesh_.normals.push_back(length > 0 ? z_up(n / length) : Vec3(0));
      }
    }
    all_normals_ = all_normals_ && mesh_.normals.size() == mesh_.positions.size();
    mesh_.normals.resize(mesh_.positions.size());
  }

  void add_uvs(const tinygltf::Primitive& primitive) {
    const auto found = primitive.attributes.find("TEXCOORD_0");
    if (found != primitive.attributes.end()) {
      const GltfNumbers uvs = model_.numbers(found->second, TINYGLTF_TYPE_VEC2);
      for (std::size_t k = 0; k < uvs.count(); ++k)
        mesh_.uvs.emplace_back(static_cast<float>(uvs(k, 0)), static_cast<float>(1 - uvs(k, 1)));
    }
    all_uvs_ = all_uvs_ && mesh_.uvs.size() == mesh_.positions.size();
    mesh_.uvs.resize(mesh_.positions.size());
  }

  GltfModel model_;
  TriangleMesh mesh_;
  PartCollector parts_;
  // The first vertex of those that primitives of one node share, by their accessors.
  std::map<std::map<std::string, int>, std::uint32_t> vertices_;
  bool all_normals_ = true;
  bool all_uvs_ = true;
};

}  // namespace

TriangleMesh parse_gltf(std::string_view bytes, const std::string& file) {
  return GltfReader(bytes, file).read();
}

}  // namespace wold
