#pragma once
// Reading a mesh, moving its vertices, writing it and reading that.

#include <algorithm>
#include <optional>

#include "../fuzzing.hpp"
#include "mesh/editable.hpp"

namespace wold::fuzzing {

inline int edit(std::string_view bytes, const std::string& name) {
  std::optional<EditableMesh> mesh;
  if (!accepts([&] { mesh = EditableMesh::parse(std::string(bytes), name); })) return 0;
  require(mesh->bytes() == bytes);
  for (std::size_t k = 0; k < mesh->positions().size(); k += 2) mesh->positions()[k].z += 0.25;
  std::optional<EditableMesh> again;
  // What was moved may exceed the range of a float.
  if (!accepts([&] { again = EditableMesh::parse(mesh->bytes(), name); })) return 0;
  require(again->positions().size() == mesh->positions().size());
  require(std::equal(again->triangles().begin(), again->triangles().end(),
                     mesh->triangles().begin(), mesh->triangles().end()));
  return 0;
}

}  // namespace wold::fuzzing
