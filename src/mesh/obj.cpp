#include "mesh/obj.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <iterator>
#include <map>
#include <span>

#include "base/error.hpp"
#include "mesh/parts.hpp"

namespace wold {

namespace {

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blank = " \t\r";
  const auto first = text.find_first_not_of(blank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blank) - first + 1);
}

/// Takes the first word off a line.
std::string_view take_word(std::string_view& line) {
  line = trimmed(line);
  const auto end = std::min(line.find_first_of(" \t"), line.size());
  const std::string_view word = line.substr(0, end);
  line = trimmed(line.substr(end));
  return word;
}

class ObjParser {
 public:
  explicit ObjParser(const std::string& file) : where_{file, 0, 0} {}

  TriangleMesh parse(std::string_view text) {
    while (!text.empty()) {
      const auto end = std::min(text.find('\n'), text.size());
      ++where_.line;
      statement(trimmed(text.substr(0, end)));
      text.remove_prefix(std::min(end + 1, text.size()));
    }
    if (!all_normals_) mesh_.normals.clear();
    if (!all_uvs_) mesh_.uvs.clear();
    parts_.finish(mesh_);
    return std::move(mesh_);
  }

 private:
  using Corner = std::array<int, 3>;  // position, texture coordinates, normal; -1 for none

  [[noreturn]] void fail(const std::string& message) const {
    throw Error(ErrorKind::input, message, where_);
  }

  void statement(std::string_view line) {
    line = line.substr(0, line.find('#'));
    const std::string_view keyword = take_word(line);
    if (keyword == "v") {
      positions_.push_back(vector<Vec3>(line, 3));
    } else if (keyword == "vn") {
      normals_.push_back(vector<Vec3>(line, 3));
    } else if (keyword == "vt") {
      uvs_.push_back(vector<Vec2>(line, 2));
    } else if (keyword == "f") {
      face(line);
    } else if (keyword == "usemtl") {
      parts_.use_material(std::string(line));
    }
    // What else a file holds (names, groups, smoothing, lines) has no place in a mesh.
  }

  template <class Vector>
  Vector vector(std::string_view line, int count) const {
    Vector v{};
    for (int k = 0; k < count; ++k) {
      const std::string_view word = take_word(line);
      if (word.empty()) fail(fmt::format("{} numbers are expected here, found {}", count, k));
      v[k] = number(word);
    }
    return v;
  }

  float number(std::string_view word) const {
    std::string_view digits = word;
    if (digits.front() == '+') digits.remove_prefix(1);
    float value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    // Denormal numbers are out of range too; they are as good as 0.
    if (error == std::errc::invalid_argument || end != digits.data() + digits.size())
      fail(fmt::format("'{}' is not a number", word));
    return value;
  }

  /// "7", "7/2", "7//3", "7/2/3"; counted from 1, or backwards from the last if negative.
  Corner corner(std::string_view word) const {
    const std::array<std::size_t, 3> counts{positions_.size(), uvs_.size(), normals_.size()};
    Corner corner{-1, -1, -1};
    std::string_view rest = word;
    for (std::size_t k = 0; k < 3 && !rest.empty(); ++k) {
      const auto end = std::min(rest.find('/'), rest.size());
      const std::string_view digits = rest.substr(0, end);
      rest.remove_prefix(std::min(end + 1, rest.size()));
      if (digits.empty() && k > 0) continue;
      corner[k] = index(digits, word, counts[k]);
    }
    if (!rest.empty()) fail(fmt::format("'{}' is not a corner like 1, 1/2, 1//3 or 1/2/3", word));
    return corner;
  }

  int index(std::string_view digits, std::string_view word, std::size_t count) const {
    long long value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc() || end != digits.data() + digits.size())
      fail(fmt::format("'{}' is not a corner like 1, 1/2, 1//3 or 1/2/3", word));
    const long long from_zero = value < 0 ? static_cast<long long>(count) + value : value - 1;
    if (from_zero < 0 || from_zero >= static_cast<long long>(count))
      fail(fmt::format("'{}' refers to number {}, but there are {} before this line", word, value,
                       count));
    return static_cast<int>(from_zero);
  }

  void face(std::string_view line) {
    corners_.clear();
    while (!line.empty()) corners_.push_back(vertex(corner(take_word(line))));
    if (corners_.size() < 3)
      fail(fmt::format("a face has at least 3 corners, this one has {}", corners_.size()));
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

  SourceLocation where_;
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
  return ObjParser(file).parse(text);
}

}  // namespace wold
