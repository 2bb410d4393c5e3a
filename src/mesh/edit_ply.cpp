#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "mesh/edit.hpp"
#include "mesh/ply_reader.hpp"

namespace wold::mesh_edit {

namespace {

constexpr std::array<std::string_view, 6> names{"x", "y", "z", "nx", "ny", "nz"};
constexpr int not_ours = -1;

/// For each property of a vertex its place in `names`.
std::vector<int> slots_of(const PlyElement& element, const PlyReader& reader) {
  std::vector<int> slots;
  for (const PlyProperty& p : element.properties) {
    const auto found = std::find(names.begin(), names.end(), p.name);
    const auto slot = static_cast<int>(found - names.begin());
    const bool repeated = std::find(slots.begin(), slots.end(), slot) != slots.end();
    const bool ours = found != names.end() && !p.count_type && !repeated;
    slots.push_back(ours ? slot : not_ours);
    if (ours && p.type != PlyType::float32 && p.type != PlyType::float64)
      reader.fail(fmt::format("the vertices' {} is a whole number, which cannot be moved", p.name));
  }
  for (int k = 0; k < 3; ++k)
    if (std::find(slots.begin(), slots.end(), k) == slots.end())
      reader.fail("the vertices have no x, y and z");
  return slots;
}

bool has_normals(const std::vector<int>& slots) {
  return std::all_of(names.begin() + 3, names.end(), [&](std::string_view name) {
    const auto slot = static_cast<int>(std::find(names.begin(), names.end(), name) - names.begin());
    return std::find(slots.begin(), slots.end(), slot) != slots.end();
  });
}

/// Reads one vertex; `visit(slot, number, property)` for each property of ours.
template <class Visit>
void read_vertex(PlyReader& reader, const PlyElement& element, const std::vector<int>& slots,
                 const Visit& visit) {
  for (std::size_t k = 0; k < slots.size(); ++k) {
    const PlyProperty& p = element.properties[k];
    if (slots[k] == not_ours)
      reader.skip(p);
    else
      visit(slots[k], reader.number(p.type), p);
  }
}

void add_vertices(PlyReader& reader, const PlyElement& element, Content& content) {
  const std::vector<int> slots = slots_of(element, reader);
  const bool normals = has_normals(slots);
  for (std::uint64_t k = 0; k < element.count; ++k) {
    std::array<double, names.size()> values{};
    read_vertex(reader, element, slots, [&](int slot, double value, const PlyProperty&) {
      values[static_cast<std::size_t>(slot)] = value;
    });
    const auto index = static_cast<std::uint32_t>(content.positions.size());
    content.positions.emplace_back(values[0], values[1], values[2]);
    if (normals) content.points.push_back({index, Vec3(DVec3(values[3], values[4], values[5]))});
  }
}

void add_faces(PlyReader& reader, const PlyElement& element, Content& content) {
  for (std::uint64_t k = 0; k < element.count; ++k)
    for (const PlyProperty& p : element.properties) {
      if (!p.is_vertex_list()) {
        reader.skip(p);
        continue;
      }
      const std::size_t count = reader.list_size(p);
      UVec3 t(0);
      for (std::size_t c = 0; c < count; ++c) {
        const std::uint32_t index = reader.vertex_index(p);
        t = c == 0 ? UVec3(index) : UVec3(t.x, t.z, index);
        if (c >= 2) content.triangles.push_back(t);
      }
    }
}

void check_triangles(const PlyReader& reader, const Content& content) {
  const auto count = static_cast<std::uint32_t>(content.positions.size());
  for (const UVec3& t : content.triangles)
    if (t.x >= count || t.y >= count || t.z >= count)
      reader.fail(fmt::format("a face refers to vertex {}, but there are {} (counted from 0)",
                              std::max({t.x, t.y, t.z}), count));
}

void skip_element(PlyReader& reader, const PlyElement& element) {
  for (std::uint64_t k = 0; k < element.count; ++k)
    for (const PlyProperty& p : element.properties) reader.skip(p);
}

}  // namespace

Content ply_content(std::string_view bytes, const std::string& file) {
  PlyReader reader(bytes, file);
  Content content;
  bool has_vertices = false;
  for (const PlyElement& element : reader.read_header().elements) {
    reader.check_count(element);
    if (element.properties.empty()) continue;
    if (element.name == "vertex") {
      if (has_vertices) reader.fail("the vertices come twice");
      has_vertices = true;
      add_vertices(reader, element, content);
    } else if (element.name == "face") {
      add_faces(reader, element, content);
    } else {
      skip_element(reader, element);
    }
  }
  check_triangles(reader, content);
  if (!content.points.empty()) content.triangle_points = content.triangles;
  return content;
}

std::string edited_ply(std::string_view bytes, const std::string& file, const Edit& edit) {
  PlyReader reader(bytes, file);
  Patch patch(bytes);
  const PlyHeader& header = reader.read_header();
  for (const PlyElement& element : header.elements) {
    if (element.properties.empty()) continue;
    if (element.name != "vertex") {
      skip_element(reader, element);
      continue;
    }
    const std::vector<int> slots = slots_of(element, reader);
    for (std::size_t k = 0; k < element.count; ++k)
      read_vertex(reader, element, slots, [&](int slot, double, const PlyProperty& p) {
        const bool normal = slot >= 3;
        if (normal && (edit.turned.empty() || edit.turned[k] == 0)) return;
        const double before = normal ? static_cast<double>(edit.before.points[k].normal[slot - 3])
                                     : edit.before.positions[k][slot];
        const double after =
            normal ? static_cast<double>(edit.normals[k][slot - 3]) : edit.positions[k][slot];
        if (after != before)
          patch.replace(reader.last(), ply_bytes_of(after, p.type, header.format));
      });
    break;  // what follows stays as it is
  }
  return std::move(patch).finish();
}

}  // namespace wold::mesh_edit
