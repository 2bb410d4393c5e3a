#include "mesh/ply.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <iterator>
#include <map>

#include "mesh/parts.hpp"
#include "mesh/ply_reader.hpp"

namespace wold {

namespace {

class PlyParser {
 public:
  PlyParser(std::string_view bytes, const std::string& file)
      : reader_(bytes, file), header_(reader_.read_header()) {}

  TriangleMesh parse() {
    for (const PlyElement& element : header_.elements) read(element);
    for (const UVec3& t : triangles_) {
      const auto count = static_cast<std::uint32_t>(mesh_.positions.size());
      if (t.x >= count || t.y >= count || t.z >= count)
        reader_.fail(fmt::format("a face refers to vertex {}, but there are {} (counted from 0)",
                                 std::max({t.x, t.y, t.z}), count));
    }
    parts_.finish(mesh_);
    return std::move(mesh_);
  }

 private:
  void read(const PlyElement& element) {
    reader_.check_count(element);
    if (element.properties.empty()) return;
    if (element.name == "vertex") return vertices(element);
    for (std::uint64_t k = 0; k < element.count; ++k) {
      if (element.name == "face")
        face(element);
      else
        for (const PlyProperty& p : element.properties) reader_.skip(p);
    }
  }

  void vertices(const PlyElement& element) {
    enum Slot { x, y, z, nx, ny, nz, u, v, slots };
    static const std::map<std::string_view, Slot> names{
        {"x", x}, {"y", y}, {"z", z}, {"nx", nx},       {"ny", ny},       {"nz", nz},
        {"u", u}, {"v", v}, {"s", u}, {"texture_u", u}, {"texture_v", v}, {"t", v}};
    std::array<bool, slots> has{};
    for (const PlyProperty& p : element.properties)
      if (const auto slot = names.find(p.name); slot != names.end()) has[slot->second] = true;
    if (!has[x] || !has[y] || !has[z]) reader_.fail("the vertices have no x, y and z");
    for (std::uint64_t k = 0; k < element.count; ++k) {
      std::array<float, slots> values{};
      for (const PlyProperty& p : element.properties) {
        const auto slot = names.find(p.name);
        if (slot == names.end() || p.count_type)
          reader_.skip(p);
        else
          values[slot->second] = static_cast<float>(reader_.number(p.type));
      }
      mesh_.positions.emplace_back(values[x], values[y], values[z]);
      if (has[nx] && has[ny] && has[nz])
        mesh_.normals.emplace_back(values[nx], values[ny], values[nz]);
      if (has[u] && has[v]) mesh_.uvs.emplace_back(values[u], values[v]);
    }
  }

  void face(const PlyElement& element) {
    corners_.clear();
    long long material = -1;
    for (const PlyProperty& p : element.properties) {
      if (p.is_vertex_list()) {
        const std::size_t count = reader_.list_size(p);
        for (std::size_t k = 0; k < count; ++k) corners_.push_back(reader_.vertex_index(p));
      } else if (p.name == "material_index" && !p.count_type) {
        material = static_cast<long long>(std::clamp(reader_.number(p.type), -1.0, 4e9));
      } else {
        reader_.skip(p);
      }
    }
    const auto name = header_.materials.find(material);
    if (material != material_ || triangles_.empty())
      parts_.use_material(name == header_.materials.end() ? "" : name->second);
    material_ = material;
    for (std::size_t k = 2; k < corners_.size(); ++k) {
      triangles_.emplace_back(corners_[0], corners_[k - 1], corners_[k]);
      parts_.add(triangles_.back());
    }
  }

  PlyReader reader_;
  const PlyHeader& header_;
  TriangleMesh mesh_;
  std::vector<UVec3> triangles_;  // kept until the vertices are known: elements come in any order
  PartCollector parts_;
  std::vector<std::uint32_t> corners_;
  long long material_ = -1;
};

template <class T>
void append(std::string& bytes, const T& value) {
  static_assert(std::endian::native == std::endian::little);
  std::array<char, sizeof(T)> raw{};
  std::memcpy(raw.data(), &value, sizeof(T));
  bytes.append(raw.data(), raw.size());
}

std::string ply_header(const TriangleMesh& mesh, const std::vector<MeshPart>& parts) {
  std::string text = "ply\nformat binary_little_endian 1.0\ncomment wold: metres, Z up\n";
  for (std::size_t k = 0; k < parts.size(); ++k)
    if (!parts[k].material.empty())
      text += fmt::format("comment material {} {}\n", k, parts[k].material);
  text += fmt::format("element vertex {}\n", mesh.positions.size());
  for (const char* name : {"x", "y", "z"}) text += fmt::format("property float {}\n", name);
  if (!mesh.normals.empty())
    for (const char* name : {"nx", "ny", "nz"}) text += fmt::format("property float {}\n", name);
  if (!mesh.uvs.empty())
    for (const char* name : {"u", "v"}) text += fmt::format("property float {}\n", name);
  text += fmt::format(
      "element face {}\nproperty list uchar int vertex_indices\nproperty int material_index\n"
      "end_header\n",
      mesh.triangles.size());
  return text;
}

}  // namespace

std::string ply_bytes(const TriangleMesh& mesh) {
  check_mesh(mesh);
  const std::vector<MeshPart> parts = all_parts(mesh);
  std::string bytes = ply_header(mesh, parts);
  bytes.reserve(bytes.size() + mesh.positions.size() * 32 + mesh.triangles.size() * 17);
  for (std::size_t k = 0; k < mesh.positions.size(); ++k) {
    append(bytes, mesh.positions[k]);
    if (!mesh.normals.empty()) append(bytes, mesh.normals[k]);
    if (!mesh.uvs.empty()) append(bytes, mesh.uvs[k]);
  }
  for (std::size_t k = 0; k < parts.size(); ++k)
    for (std::uint32_t t = 0; t < parts[k].triangle_count; ++t) {
      append(bytes, std::uint8_t{3});
      append(bytes, mesh.triangles[parts[k].first_triangle + t]);
      append(bytes, static_cast<std::int32_t>(k));
    }
  return bytes;
}

TriangleMesh parse_ply(std::string_view bytes, const std::string& file) {
  return PlyParser(bytes, file).parse();
}

}  // namespace wold
