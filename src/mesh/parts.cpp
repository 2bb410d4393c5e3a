#include "mesh/parts.hpp"

#include <algorithm>

#include "base/error.hpp"

namespace wold {

void PartCollector::use_material(const std::string& name) {
  const auto [place, is_new] = index_.emplace(name, names_.size());
  if (is_new) {
    names_.push_back(name);
    triangles_.emplace_back();
  }
  current_ = place->second;
}

void PartCollector::add(UVec3 triangle) {
  if (names_.empty()) use_material("");
  triangles_[current_].push_back(triangle);
}

void PartCollector::finish(TriangleMesh& mesh) const {
  mesh.triangles.clear();
  mesh.parts.clear();
  for (std::size_t k = 0; k < names_.size(); ++k) {
    if (triangles_[k].empty()) continue;
    mesh.parts.push_back({names_[k], static_cast<std::uint32_t>(mesh.triangles.size()),
                          static_cast<std::uint32_t>(triangles_[k].size())});
    mesh.triangles.insert(mesh.triangles.end(), triangles_[k].begin(), triangles_[k].end());
  }
}

std::vector<MeshPart> all_parts(const TriangleMesh& mesh) {
  if (!mesh.parts.empty()) return mesh.parts;
  return {{"", 0, static_cast<std::uint32_t>(mesh.triangles.size())}};
}

void check_mesh(const TriangleMesh& mesh) {
  const std::size_t count = mesh.positions.size();
  const bool attributes_fit = (mesh.normals.empty() || mesh.normals.size() == count) &&
                              (mesh.uvs.empty() || mesh.uvs.size() == count);
  const bool indices_fit = std::all_of(mesh.triangles.begin(), mesh.triangles.end(), [&](UVec3 t) {
    return t.x < count && t.y < count && t.z < count;
  });
  std::size_t covered = 0;
  bool parts_fit = true;
  for (const MeshPart& part : all_parts(mesh)) {
    parts_fit = parts_fit && part.first_triangle == covered;
    covered += part.triangle_count;
  }
  if (!attributes_fit || !indices_fit || !parts_fit || covered != mesh.triangles.size())
    throw Error(ErrorKind::internal, "a mesh to be written does not fit together");
}

}  // namespace wold
