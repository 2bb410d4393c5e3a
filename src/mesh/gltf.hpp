#pragma once
// glTF 2.0 from and to files; mesh/io.hpp says what is kept.

#include <string>

#include "base/mesh.hpp"

namespace wold {

std::string glb_bytes(const TriangleMesh& mesh);

/// Binary (.glb) or text (.gltf). Throws Error(input) naming the file.
TriangleMesh read_gltf(const std::string& path);

}  // namespace wold
