#pragma once
// A glTF file as tinygltf reads it, with every index and every reach into a buffer checked; used by
// all that reads glTF.

#include <tiny_gltf.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <functional>
#include <glm/ext/matrix_double4x4.hpp>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "base/vec.hpp"

namespace wold {

using DMat4 = glm::dmat4;

/// The numbers of an accessor, as they are, whatever their type in the file.
class GltfNumbers {
 public:
  GltfNumbers(const unsigned char* data, const tinygltf::Accessor& accessor, std::size_t stride)
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

class GltfModel {
 public:
  /// `file` is for messages, and its folder that of the files it names. Throws Error(input).
  GltfModel(std::string_view bytes, const std::string& file);

  const tinygltf::Model& operator*() const { return model_; }
  const tinygltf::Model* operator->() const { return &model_; }

  [[noreturn]] void fail(const std::string& why) const;

  /// Throws unless there is one of that index.
  template <class T>
  const T& item(const std::vector<T>& items, int index, const char* what) const {
    if (index < 0 || static_cast<std::size_t>(index) >= items.size()) fail_index(index, what);
    return items[static_cast<std::size_t>(index)];
  }

  /// The numbers of an accessor of this type (TINYGLTF_TYPE_VEC3).
  GltfNumbers numbers(int accessor, int type) const;

  using Visitor = std::function<void(int node, const DMat4& transform)>;
  /// Visits the nodes of the scene that have a mesh, with their transform to the world.
  void visit_meshes(const Visitor& visitor) const;

  /// The vertices of a primitive's triangles, counted from 0; none where it has no triangles.
  /// Throws unless they are below `count`, the number of its positions.
  std::vector<UVec3> triangles(const tinygltf::Primitive& primitive, std::size_t count) const;
  /// The accessor of its positions, for a primitive with triangles; else -1.
  int positions_of(const tinygltf::Primitive& primitive) const;

 private:
  [[noreturn]] void fail_index(int index, const char* what) const;
  void visit(int index, const DMat4& parent, int depth, std::size_t& visited,
             const Visitor& visitor) const;
  std::vector<std::uint32_t> corners(const tinygltf::Primitive& primitive, std::size_t count) const;

  std::string file_;
  tinygltf::Model model_;
};

}  // namespace wold
