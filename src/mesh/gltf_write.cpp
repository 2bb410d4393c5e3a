#include <fmt/format.h>
#include <tiny_gltf.h>

#include <array>
#include <bit>
#include <cstring>
#include <sstream>

#include "base/error.hpp"
#include "mesh/gltf.hpp"
#include "mesh/parts.hpp"

namespace wold {

namespace {

static_assert(std::endian::native == std::endian::little, "glTF stores little endian numbers");

Vec3 y_up(Vec3 v) {
  return {v.x, v.z, -v.y};
}

/// Builds a model with one buffer.
class ModelBuilder {
 public:
  ModelBuilder() { model_.buffers.emplace_back(); }

  /// The index of a new accessor of these values.
  template <class T>
  int add(const std::vector<T>& values, int type, int component, int target) {
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = bytes().size();
    view.byteLength = values.size() * sizeof(T);
    view.target = target;
    bytes().resize(view.byteOffset + view.byteLength);
    if (!values.empty())
      std::memcpy(bytes().data() + view.byteOffset, values.data(), view.byteLength);
    tinygltf::Accessor accessor;
    accessor.bufferView = static_cast<int>(model_.bufferViews.size());
    accessor.componentType = component;
    accessor.type = type;
    accessor.count = type == TINYGLTF_TYPE_SCALAR ? values.size() * sizeof(T) / 4 : values.size();
    model_.bufferViews.push_back(std::move(view));
    model_.accessors.push_back(std::move(accessor));
    return static_cast<int>(model_.accessors.size()) - 1;
  }

  int add_material(const std::string& name) {
    tinygltf::Material material;
    material.name = name;
    material.pbrMetallicRoughness.metallicFactor = 0;
    material.doubleSided = true;  // leaves have no back
    model_.materials.push_back(std::move(material));
    return static_cast<int>(model_.materials.size()) - 1;
  }

  tinygltf::Model& model() { return model_; }

 private:
  std::vector<unsigned char>& bytes() { return model_.buffers.front().data; }

  tinygltf::Model model_;
};

std::vector<Vec3> turned(const std::vector<Vec3>& vectors) {
  std::vector<Vec3> result;
  result.reserve(vectors.size());
  for (const Vec3& v : vectors) result.push_back(y_up(v));
  return result;
}

std::map<std::string, int> add_attributes(ModelBuilder& builder, const TriangleMesh& mesh) {
  constexpr int target = TINYGLTF_TARGET_ARRAY_BUFFER;
  constexpr int component = TINYGLTF_COMPONENT_TYPE_FLOAT;
  std::map<std::string, int> attributes;
  const int position = builder.add(turned(mesh.positions), TINYGLTF_TYPE_VEC3, component, target);
  TriangleMesh bounded;
  bounded.positions = turned(mesh.positions);
  const auto [low, high] = bounded.bounds();
  tinygltf::Accessor& accessor = builder.model().accessors[static_cast<std::size_t>(position)];
  for (int c = 0; c < 3; ++c) {
    accessor.minValues.push_back(static_cast<double>(low[c]));
    accessor.maxValues.push_back(static_cast<double>(high[c]));
  }
  attributes["POSITION"] = position;
  if (!mesh.normals.empty())
    attributes["NORMAL"] = builder.add(turned(mesh.normals), TINYGLTF_TYPE_VEC3, component, target);
  if (!mesh.uvs.empty()) {
    std::vector<Vec2> uvs;
    for (const Vec2& uv : mesh.uvs) uvs.emplace_back(uv.x, 1 - uv.y);
    attributes["TEXCOORD_0"] = builder.add(uvs, TINYGLTF_TYPE_VEC2, component, target);
  }
  return attributes;
}

tinygltf::Mesh primitives_of(ModelBuilder& builder, const TriangleMesh& mesh) {
  tinygltf::Mesh result;
  const auto attributes = add_attributes(builder, mesh);
  for (const MeshPart& part : all_parts(mesh)) {
    if (part.triangle_count == 0) continue;
    const auto first = mesh.triangles.begin() + part.first_triangle;
    const std::vector<UVec3> triangles(first, first + part.triangle_count);
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.attributes = attributes;
    primitive.indices =
        builder.add(triangles, TINYGLTF_TYPE_SCALAR, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT,
                    TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
    if (!part.material.empty()) primitive.material = builder.add_material(part.material);
    result.primitives.push_back(std::move(primitive));
  }
  return result;
}

}  // namespace

std::string glb_bytes(const TriangleMesh& mesh) {
  check_mesh(mesh);
  const std::size_t vertex_size =
      12 + (mesh.normals.empty() ? 0U : 12U) + (mesh.uvs.empty() ? 0U : 8U);
  const double size = static_cast<double>(mesh.positions.size() * vertex_size) +
                      static_cast<double>(mesh.triangles.size()) * 12;
  if (size > 4.0e9)
    throw Error(
        ErrorKind::limit,
        fmt::format("a GLB holds at most 4 GB, this mesh needs {:.1f} GB; write PLY", size / 1e9));
  ModelBuilder builder;
  tinygltf::Model& model = builder.model();
  model.asset.version = "2.0";
  model.asset.generator = "wold";
  tinygltf::Node node;
  node.name = "wold";
  if (mesh.triangles.empty()) {
    model.buffers.clear();
  } else {
    model.meshes.push_back(primitives_of(builder, mesh));
    node.mesh = 0;
  }
  model.nodes.push_back(std::move(node));
  tinygltf::Scene scene;
  scene.nodes.push_back(0);
  model.scenes.push_back(std::move(scene));
  model.defaultScene = 0;
  std::ostringstream out;
  tinygltf::TinyGLTF writer;
  if (!writer.WriteGltfSceneToStream(&model, out, false, true))
    throw Error(ErrorKind::internal, "a mesh could not be written as GLB");
  return std::move(out).str();
}

}  // namespace wold
