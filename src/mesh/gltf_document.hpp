#pragma once
// A glTF file as its own JSON and buffers, to be changed here and there and written again with all
// else kept, also what no library knows.

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/gltf_model.hpp"

namespace wold {

class GltfDocument {
 public:
  using Json = nlohmann::ordered_json;

  /// `model` is of the same file. Throws Error(input).
  GltfDocument(std::string_view bytes, const GltfModel& model);

  Json& json() { return json_; }

  /// Sets one vector of an accessor of floats, in its place.
  void set(int accessor, std::size_t k, const Vec3& value);
  /// The index of a new accessor of these vectors.
  int add(const std::vector<Vec3>& values);
  /// Writes the bounds of `values` to an accessor.
  void set_bounds(int accessor, const std::vector<Vec3>& values);

  /// The file, binary or text as it was. Throws Error(limit) where a GLB would exceed 4 GiB.
  std::string bytes() const;

 private:
  void read_chunks(std::string_view bytes);
  void check_shape() const;
  bool is_binary_chunk(std::size_t buffer) const;

  const GltfModel& model_;
  Json json_;
  bool binary_ = false;
  bool indented_ = false;
  std::string other_chunks_;
  std::vector<std::vector<unsigned char>> buffers_;
};

}  // namespace wold
