#pragma once
// What the formats of EditableMesh share: what they find in a file, what changed, and the writing
// of bytes with some of them replaced.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/editable.hpp"

namespace wold::mesh_edit {

/// The new positions and normals, in the file's axes.
struct Edit {
  const Content& before;
  const std::vector<DVec3>& positions;
  std::vector<Vec3> normals;         ///< one per point
  std::vector<std::uint8_t> turned;  ///< per point: its normal is new

  bool moved(std::size_t k) const { return positions[k] != before.positions[k]; }
};

/// Finds the new normals.
Edit edit_of(const Content& before, const std::vector<DVec3>& positions);

Content obj_content(std::string_view bytes, const std::string& file);
std::string edited_obj(std::string_view bytes, const std::string& file, const Edit& edit);

Content ply_content(std::string_view bytes, const std::string& file);
std::string edited_ply(std::string_view bytes, const std::string& file, const Edit& edit);

Content gltf_content(std::string_view bytes, const std::string& file);
std::string edited_gltf(std::string_view bytes, const std::string& file, const Edit& edit);

/// A text with parts replaced, from its front to its end.
class Patch {
 public:
  explicit Patch(std::string_view source) : source_(source) { out_.reserve(source.size()); }

  /// `part` is a view into the source, behind those before.
  void replace(std::string_view part, std::string_view with) {
    const auto at = static_cast<std::size_t>(part.data() - source_.data());
    out_.append(source_.substr(copied_, at - copied_));
    out_.append(with);
    copied_ = at + part.size();
  }
  std::string finish() && {
    out_.append(source_.substr(copied_));
    return std::move(out_);
  }

 private:
  std::string_view source_;
  std::string out_;
  std::size_t copied_ = 0;
};

/// A number in a text file.
std::string number_text(double value);

}  // namespace wold::mesh_edit
