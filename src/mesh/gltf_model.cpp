#include "mesh/gltf_model.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <glm/ext/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include "base/error.hpp"
#include "image/atomic_file.hpp"

namespace wold {

namespace {

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

/// The JSON of a file, binary or text.
std::string_view json_of(std::string_view bytes, bool binary) {
  constexpr std::size_t begin = 20;  // behind the head of the file and of its first chunk
  if (!binary || bytes.size() < begin) return bytes;
  std::uint32_t size = 0;
  std::memcpy(&size, bytes.data() + 12, sizeof(size));
  return bytes.substr(begin, size);
}

/// Whether brackets stand within brackets deeper than the library, which calls itself for each,
/// can follow.
bool is_too_deep(std::string_view json) {
  constexpr int deepest = 512;
  int depth = 0;
  bool in_text = false;
  for (std::size_t k = 0; k < json.size(); ++k) {
    const char c = json[k];
    if (in_text && c == '\\') {
      ++k;
    } else if (c == '"') {
      in_text = !in_text;
    } else if (!in_text && (c == '[' || c == '{')) {
      if (++depth > deepest) return true;
    } else if (!in_text && (c == ']' || c == '}')) {
      --depth;
    }
  }
  return false;
}

DMat4 transform_of(const tinygltf::Node& node) {
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

}  // namespace

GltfModel::GltfModel(std::string_view bytes, const std::string& file) : file_(file) {
  tinygltf::TinyGLTF loader;
  loader.SetImageLoader(ignore_image, nullptr);
  std::string error;
  std::string warning;
  if (bytes.size() > std::numeric_limits<unsigned>::max()) fail("it exceeds 4 GiB");
  const auto size = static_cast<unsigned>(bytes.size());
  const std::string folder = std::filesystem::path(file).parent_path().string();
  const bool binary = bytes.starts_with("glTF");
  if (is_too_deep(json_of(bytes, binary))) fail("its JSON is nested too deeply");
  const bool loaded =
      binary
          ? loader.LoadBinaryFromMemory(&model_, &error, &warning,
                                        reinterpret_cast<const unsigned char*>(bytes.data()), size,
                                        folder)
          : extension_of(file) == ".gltf" &&
                loader.LoadASCIIFromString(&model_, &error, &warning, bytes.data(), size, folder);
  if (!loaded) fail(error.empty() ? "it does not begin with 'glTF'" : one_line(error));
  for (const char* extension : {"KHR_draco_mesh_compression", "EXT_meshopt_compression"})
    if (std::count(model_.extensionsRequired.begin(), model_.extensionsRequired.end(), extension) >
        0)
      fail(fmt::format("its extension {} is not supported; export without compression", extension));
}

void GltfModel::fail(const std::string& why) const {
  throw Error(ErrorKind::input, fmt::format("'{}' is no sound glTF file: {}", file_, why));
}

void GltfModel::fail_index(int index, const char* what) const {
  fail(fmt::format("{} {} does not exist", what, index));
}

GltfNumbers GltfModel::numbers(int index, int type) const {
  const tinygltf::Accessor& accessor = item(model_.accessors, index, "accessor");
  if (accessor.sparse.isSparse) fail("sparse accessors are not supported");
  if (accessor.type != type) fail(fmt::format("accessor {} has the wrong type", index));
  const auto& view = item(model_.bufferViews, accessor.bufferView, "buffer view");
  const auto& buffer = item(model_.buffers, view.buffer, "buffer");
  const int stride = accessor.ByteStride(view);
  const int size =
      tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(accessor.componentType)) *
      tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(type));
  if (stride <= 0 || size <= 0) fail(fmt::format("accessor {} has no type", index));
  const double end = static_cast<double>(accessor.byteOffset) +
                     (static_cast<double>(accessor.count) - 1) * stride + size;
  const double available =
      std::min(static_cast<double>(view.byteLength),
               static_cast<double>(buffer.data.size()) - static_cast<double>(view.byteOffset));
  if (accessor.count > 0 && end > available)
    fail(fmt::format("accessor {} reaches beyond its buffer", index));
  return {buffer.data.data() + view.byteOffset + accessor.byteOffset, accessor,
          static_cast<std::size_t>(stride)};
}

void GltfModel::visit_meshes(const Visitor& visitor) const {
  const int scene = std::max(0, model_.defaultScene);
  if (static_cast<std::size_t>(scene) >= model_.scenes.size()) return;
  std::size_t visited = 0;
  for (const int node : model_.scenes[static_cast<std::size_t>(scene)].nodes)
    visit(node, DMat4(1), 0, visited, visitor);
}

void GltfModel::visit(int index, const DMat4& parent, int depth, std::size_t& visited,
                      const Visitor& visitor) const {
  // Each node has one parent at most: else nodes that share children would multiply.
  if (++visited > model_.nodes.size() || depth > 1000) fail("its nodes are not a tree");
  const tinygltf::Node& node = item(model_.nodes, index, "node");
  const DMat4 transform = parent * transform_of(node);
  if (node.mesh >= 0) {
    item(model_.meshes, node.mesh, "mesh");
    visitor(index, transform);
  }
  for (const int child : node.children) visit(child, transform, depth + 1, visited, visitor);
}

int GltfModel::positions_of(const tinygltf::Primitive& primitive) const {
  const bool has_triangles = primitive.mode == TINYGLTF_MODE_TRIANGLES ||
                             primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP ||
                             primitive.mode == TINYGLTF_MODE_TRIANGLE_FAN;
  if (!has_triangles) return -1;
  if (primitive.extensions.count("KHR_draco_mesh_compression") != 0)
    fail("Draco compression is not supported; export without compression");
  const auto position = primitive.attributes.find("POSITION");
  if (position == primitive.attributes.end()) fail("a primitive has no positions");
  return position->second;
}

std::vector<std::uint32_t> GltfModel::corners(const tinygltf::Primitive& primitive,
                                              std::size_t count) const {
  std::vector<std::uint32_t> corners;
  if (primitive.indices < 0) {
    for (std::size_t k = 0; k < count; ++k) corners.push_back(static_cast<std::uint32_t>(k));
    return corners;
  }
  const GltfNumbers indices = numbers(primitive.indices, TINYGLTF_TYPE_SCALAR);
  for (std::size_t k = 0; k < indices.count(); ++k) {
    const double index = indices(k, 0);
    if (!(index >= 0 && index < static_cast<double>(count)))
      fail(fmt::format("a triangle refers to vertex {} of {}", index, count));
    corners.push_back(static_cast<std::uint32_t>(index));
  }
  return corners;
}

std::vector<UVec3> GltfModel::triangles(const tinygltf::Primitive& primitive,
                                        std::size_t count) const {
  const std::vector<std::uint32_t> c = corners(primitive, count);
  const bool list = primitive.mode == TINYGLTF_MODE_TRIANGLES;
  const bool fan = primitive.mode == TINYGLTF_MODE_TRIANGLE_FAN;
  std::vector<UVec3> triangles;
  for (std::size_t k = 2; k < c.size(); k += list ? 3 : 1) {
    const UVec3 t(c[fan ? 0 : k - 2], c[k - 1], c[k]);
    const bool odd = !list && !fan && k % 2 == 1;
    triangles.push_back(odd ? UVec3(t.x, t.z, t.y) : t);
  }
  return triangles;
}

}  // namespace wold
