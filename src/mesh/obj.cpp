#include "mesh/obj.hpp"

#include <fmt/format.h>

#include <array>
#include <iterator>
#include <map>
#include <span>

#include "mesh/obj_syntax.hpp"
#include "mesh/parts.hpp"

namespace wold {

namespace {

class ObjParser {
 public:
  ObjParser(std::string_view text, const std::string& file) : lines_(text, file) {}

  TriangleMesh parse() {
    while (lines_.next()) statement(lines_.line());
    if (!all_normals_) mesh_.normals.clear();
    if (!all_uvs_) mesh_.uvs.clear();
    parts_.finish(mesh_);
    return std::move(mesh_);
  }

 private:
  using Corner = std::array<int, 3>;  // position, texture coordinates, normal; -1 for none

  void statement(std::string_view line) {
    const std::string_view keyword = ObjLines::take_word(line);
    if (keyword == "v") {
      positions_.push_back(vector<Vec3>(line, 3));
    } else if (keyword == "vn") {
      normals_.push_back(vector<Vec3>(line, 3));
    } else if (keyword == "vt") {
      uvs_.push_back(vector<Vec2>(line, 2));
    } else if (keyword == "f") {
      face(line);
    } else if (keyword == "usemtl") {
      parts_.use_material(std::string(ObjLines::trimmed(line)));
    }
    // What else a file holds (names, groups, smoothing, lines) has no place in a mesh.
  }

  template <class Vector>
  Vector vector(std::string_view line, int count) const {
    Vector v{};
    for (int k = 0; k < count; ++k) {
      const std::string_view word = ObjLines::take_word(line);
      if (word.empty())
        lines_.fail(fmt::format("{} numbers are expected here, found {}", count, k));
      v[k] = lines_.number<float>(word);
    }
    return v;
  }

  void face(std::string_view line) {
    corners_.clear();
    for (;;) {
      const std::string_view word = ObjLines::take_word(line);
      if (word.empty()) break;
      corners_.push_back(
          vertex(lines_.corner(word, {positions_.size(), uvs_.size(), normals_.size()}).index));
    }
    if (corners_.size() < 3)
      lines_.fail(fmt::format("a face has at least 3 corners, this one has {}", corners_.size()));
    for (std::size_t k = 2; k < corners_.size(); ++k)
      parts_.add({corners_[0], corners_[k - 1], corners_[k]});
  }

  std::uint32_t vertex(const Corner& corner) {
    const auto [place, is_new] =
        vertices_.emplace(corner, static_cast<std::uint32_t>(mesh_.positions.size()));
    if (is_new) {
      const auto [position, uv, normal] = corner;
      all_uvs_ = all_uvs_ && uv >= 0;
      all_normals_ = all_normals_ && normal >= 0;
      mesh_.positions.push_back(positions_[static_cast<std::size_t>(position)]);
      mesh_.uvs.push_back(uv >= 0 ? uvs_[static_cast<std::size_t>(uv)] : Vec2(0));
      mesh_.normals.push_back(normal >= 0 ? normals_[static_cast<std::size_t>(normal)] : Vec3(0));
    }
    return place->second;
  }

  ObjLines lines_;
  TriangleMesh mesh_;
  PartCollector parts_;
  std::vector<Vec3> positions_;
  std::vector<Vec3> normals_;
  std::vector<Vec2> uvs_;
  std::vector<std::uint32_t> corners_;
  std::map<Corner, std::uint32_t> vertices_;
  bool all_normals_ = true;
  bool all_uvs_ = true;
};

}  // namespace

std::string obj_text(const TriangleMesh& mesh) {
  check_mesh(mesh);
  fmt::memory_buffer out;
  const auto to = std::back_inserter(out);
  fmt::format_to(to, "# wold: metres, Z up, counter-clockwise seen from outside\n");
  for (const Vec3& p : mesh.positions) fmt::format_to(to, "v {} {} {}\n", p.x, p.y, p.z);
  for (const Vec2& t : mesh.uvs) fmt::format_to(to, "vt {} {}\n", t.x, t.y);
  for (const Vec3& n : mesh.normals) fmt::format_to(to, "vn {} {} {}\n", n.x, n.y, n.z);
  for (const MeshPart& part : all_parts(mesh)) {
    if (!part.material.empty()) fmt::format_to(to, "usemtl {}\n", part.material);
    const std::span<const UVec3> triangles(mesh.triangles);
    for (const UVec3& t : triangles.subspan(part.first_triangle, part.triangle_count)) {
      fmt::format_to(to, "f");
      for (int c = 0; c < 3; ++c) {
        const std::uint32_t index = t[c] + 1;
        fmt::format_to(to, " {}", index);
        if (!mesh.uvs.empty()) fmt::format_to(to, "/{}", index);
        if (!mesh.normals.empty()) fmt::format_to(to, "{}{}", mesh.uvs.empty() ? "//" : "/", index);
      }
      fmt::format_to(to, "\n");
    }
  }
  return fmt::to_string(out);
}

TriangleMesh parse_obj(std::string_view text, const std::string& file) {
  return ObjParser(text, file).parse();
}

}  // namespace wold
