#pragma once
// Sorting the triangles of a mesh into parts by material: used by the readers and writers of
// files.

#include <map>
#include <string>
#include <vector>

#include "base/mesh.hpp"

namespace wold {

/// Collects triangles in any order of materials; `finish` gives parts in order of first use.
class PartCollector {
 public:
  void use_material(const std::string& name);
  void add(UVec3 triangle);
  /// Fills `triangles` and `parts`.
  void finish(TriangleMesh& mesh) const;

 private:
  std::vector<std::string> names_;
  std::vector<std::vector<UVec3>> triangles_;
  std::map<std::string, std::size_t> index_;
  std::size_t current_ = 0;
};

/// The parts, or one nameless part with everything if there are none.
std::vector<MeshPart> all_parts(const TriangleMesh& mesh);

/// Throws Error(internal) unless all indices are those of vertices, normals and texture coordinates
/// are none or one per vertex, and the parts cover the triangles.
void check_mesh(const TriangleMesh& mesh);

}  // namespace wold
