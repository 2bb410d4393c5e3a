#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <glm/ext/matrix_double4x4.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <map>

#include "base/error.hpp"
#include "image/atomic_file.hpp"
#include "mesh/gltf.hpp"
#include "mesh/parts.hpp"

namespace wold {

namespace {

using DMat4 = glm::dmat4;

/// What the library says may have several lines and blanks at its end.
std::string one_line(std::string text) {
  text = text.substr(0, text.find('\n'));
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

bool ignore_image(tinygltf::Image*, const int, std::string*, std::string*, int, int,
                  const unsigned char*, int, void*) {
  return true;
}

/// The numbers of an accessor, as they are, whatever their type in the file.
class AccessorView {
 public:
  AccessorView(const unsigned char* data, const tinygltf::Accessor& accessor, std::size_t stride)
      : data_(data), accessor_(accessor), stride_(stride) {}

  std::size_t count() const { return accessor_.count; }
  double operator()(std::size_t k, int c) const {
    const auto component = static_cast<std::size_t>(c);
    const unsigned char* at = data_ + k * stride_;
    switch (accessor_.componentType) {
      case TINYGLTF_COMPONENT_TYPE_BYTE: return normalized<std::int8_t>(at, component);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: return normalized<std::uint8_t>(at, component);
      case TINYGLTF_COMPONENT_TYPE_SHORT: return normalized<std::int16_t>(at, component);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: return normalized<std::uint16_t>(at, component);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT: return value<std::uint32_t>(at, component);
      default: return static_cast<double>(value<float>(at, component));
    }
  }

 private:
  template <class T>
  static T value(const unsigned char* at, std::size_t c) {
    T v{};
    std::memcpy(&v, at + c * sizeof(T), sizeof(T));
    return v;
  }
  template <class T>
  double normalized(const unsigned char* at, std::size_t c) const {
    const double v = value<T>(at, c);
    return accessor_.normalized ? std::max(v / std::numeric_limits<T>::max(), -1.0) : v;
  }

  const unsigned char* data_;
  const tinygltf::Accessor& accessor_;
  std::size_t stride_;
};

class GltfReader {
 public:
  explicit GltfReader(const std::string& path) : path_(path) {}

  TriangleMesh read() {
    load();
    const int scene = std::max(0, model_.defaultScene);
    if (static_cast<std::size_t>(scene) < model_.scenes.size())
      for (const int node : model_.scenes[static_cast<std::size_t>(scene)].nodes)
        visit(node, DMat4(1), 0);
    if (!all_normals_) mesh_.normals.clear();
    if (!all_uvs_) mesh_.uvs.clear();
    parts_.finish(mesh_);
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void fail(const std::string& why) const {
    throw Error(ErrorKind::input, fmt::format("'{}' is no sound glTF file: {}", path_, why));
  }

  void load() {
    const std::string bytes = read_file(path_);
    tinygltf::TinyGLTF loader;
    loader.SetImageLoader(ignore_image, nullptr);
    std::string error;
    std::string warning;
    const bool binary = bytes.rfind("glTF", 0) == 0;
    if (binary && bytes.size() > std::numeric_limits<unsigned>::max()) fail("it exceeds 4 GiB");
    const bool loaded =
        binary ? loader.LoadBinaryFromMemory(&model_, &error, &warning,
                                             reinterpret_cast<const unsigned char*>(bytes.data()),
                                             static_cast<unsigned>(bytes.size()))
               : extension_of(path_) == ".gltf" &&
                     loader.LoadASCIIFromFile(&model_, &error, &warning, path_);
    if (!loaded) fail(error.empty() ? "it does not begin with 'glTF'" : one_line(error));
  }

  template <class T>
  const T& item(const std::vector<T>& items, int index, const char* what) const {
    if (index < 0 || static_cast<std::size_t>(index) >= items.size())
      fail(fmt::format("{} {} does not exist", what, index));
    return items[static_cast<std::size_t>(index)];
  }

  static DMat4 transform_of(const tinygltf::Node& node) {
    DMat4 m(1);
    if (node.matrix.size() == 16) {
      for (int k = 0; k < 16; ++k) m[k / 4][k % 4] = node.matrix[static_cast<std::size_t>(k)];
      return m;
    }
    const auto& t = node.translation;
    const auto& r = node.rotation;
    const auto& s = node.scale;
    if (t.size() == 3) m = glm::translate(m, DVec3(t[0], t[1], t[2]));
    if (r.size() == 4) m *= glm::mat4_cast(glm::dquat(r[3], r[0], r[1], r[2]));
    if (s.size() == 3) m = glm::scale(m, DVec3(s[0], s[1], s[2]));
    return m;
  }

  void visit(int index, const DMat4& parent, int depth) {
    // Each node has one parent at most: else nodes that share children would multiply.
    if (++visited_ > model_.nodes.size() || depth > 1000) fail("its nodes are not a tree");
    const tinygltf::Node& node = item(model_.nodes, index, "node");
    const DMat4 transform = parent * transform_of(node);
    vertices_.clear();
    if (node.mesh >= 0)
      for (const auto& primitive : item(model_.meshes, node.mesh, "mesh").primitives)
        add(primitive, transform);
    for (const int child : node.children) visit(child, transform, depth + 1);
  }

  AccessorView view(int index, int type) const {
    const tinygltf::Accessor& accessor = item(model_.accessors, index, "accessor");
    if (accessor.sparse.isSparse) fail("sparse accessors are not supported");
    if (accessor.type != type) fail(fmt::format("accessor {} has the wrong type", index));
    const auto& buffer_view = item(model_.bufferViews, accessor.bufferView, "buffer view");
    const auto& buffer = item(model_.buffers, buffer_view.buffer, "buffer");
    const int stride = accessor.ByteStride(buffer_view);
    const int size =
        tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(accessor.componentType)) *
        tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(type));
    if (stride <= 0 || size <= 0) fail(fmt::format("accessor {} has no type", index));
    const double end = static_cast<double>(accessor.byteOffset) +
                       (static_cast<double>(accessor.count) - 1) * stride + size;
    const double available = std::min(
        static_cast<double>(buffer_view.byteLength),
        static_cast<double>(buffer.data.size()) - static_cast<double>(buffer_view.byteOffset));
    if (accessor.count > 0 && end > available)
      fail(fmt::format("accessor {} reaches beyond its buffer", index));
    return {buffer.data.data() + buffer_view.byteOffset + accessor.byteOffset, accessor,
            static_cast<std::size_t>(stride)};
  }

  void add(const tinygltf::Primitive& primitive, const DMat4& transform) {
    const bool has_triangles = primitive.mode == TINYGLTF_MODE_TRIANGLES ||
                               primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP ||
                               primitive.mode == TINYGLTF_MODE_TRIANGLE_FAN;
    if (!has_triangles) return;
    if (primitive.extensions.count("KHR_draco_mesh_compression") != 0)
      fail("Draco compression is not supported; export without compression");
    const auto position = primitive.attributes.find("POSITION");
    if (position == primitive.attributes.end()) fail("a primitive has no positions");
    const AccessorView positions = view(position->second, TINYGLTF_TYPE_VEC3);
    const auto [vertices, is_new] =
        vertices_.emplace(primitive.attributes, static_cast<std::uint32_t>(mesh_.positions.size()));
    if (is_new) {
      add_positions(positions, transform);
      add_normals(primitive, glm::transpose(glm::inverse(glm::dmat3(transform))));
      add_uvs(primitive);
    }
    parts_.use_material(
        primitive.material < 0 ? "" : item(model_.materials, primitive.material, "material").name);
    const bool mirrored = glm::determinant(glm::dmat3(transform)) < 0;
    add_triangles(primitive, vertices->second, positions.count(), mirrored);
  }

  void add_positions(const AccessorView& positions, const DMat4& transform) {
    for (std::size_t k = 0; k < positions.count(); ++k) {
      const glm::dvec4 p(positions(k, 0), positions(k, 1), positions(k, 2), 1);
      mesh_.positions.push_back(z_up(DVec3(transform * p)));
    }
  }

  static Vec3 z_up(DVec3 v) { return Vec3(DVec3(v.x, -v.z, v.y)); }

  void add_normals(const tinygltf::Primitive& primitive, const glm::dmat3& transform) {
    const auto found = primitive.attributes.find("NORMAL");
    if (found != primitive.attributes.end()) {
      const AccessorView normals = view(found->second, TINYGLTF_TYPE_VEC3);
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
      const AccessorView uvs = view(found->second, TINYGLTF_TYPE_VEC2);
      for (std::size_t k = 0; k < uvs.count(); ++k)
        mesh_.uvs.emplace_back(static_cast<float>(uvs(k, 0)), static_cast<float>(1 - uvs(k, 1)));
    }
    all_uvs_ = all_uvs_ && mesh_.uvs.size() == mesh_.positions.size();
    mesh_.uvs.resize(mesh_.positions.size());
  }

  void add_triangles(const tinygltf::Primitive& primitive, std::uint32_t first, std::size_t count,
                     bool mirrored) {
    std::vector<std::uint32_t> corners;
    if (primitive.indices >= 0) {
      const AccessorView indices = view(primitive.indices, TINYGLTF_TYPE_SCALAR);
      for (std::size_t k = 0; k < indices.count(); ++k) {
        const double index = indices(k, 0);
        if (!(index >= 0 && index < static_cast<double>(count)))
          fail(fmt::format("a triangle refers to vertex {} of {}", index, count));
        corners.push_back(first + static_cast<std::uint32_t>(index));
      }
    } else {
      for (std::size_t k = 0; k < count; ++k)
        corners.push_back(first + static_cast<std::uint32_t>(k));
    }
    const bool list = primitive.mode == TINYGLTF_MODE_TRIANGLES;
    const bool fan = primitive.mode == TINYGLTF_MODE_TRIANGLE_FAN;
    for (std::size_t k = 2; k < corners.size(); k += list ? 3 : 1) {
      UVec3 t(corners[fan ? 0 : k - 2], corners[k - 1], corners[k]);
      const bool odd = !list && !fan && k % 2 == 1;
      if (odd != mirrored) std::swap(t.y, t.z);
      parts_.add(t);
    }
  }

  std::string path_;
  tinygltf::Model model_;
  TriangleMesh mesh_;
  PartCollector parts_;
  std::size_t visited_ = 0;
  // The first vertex of those that primitives of one node share, by their accessors.
  std::map<std::map<std::string, int>, std::uint32_t> vertices_;
  bool all_normals_ = true;
  bool all_uvs_ = true;
};

}  // namespace

TriangleMesh read_gltf(const std::string& path) {
  return GltfReader(path).read();
}

}  // namespace wold
