#pragma once
// glTF 2.0 from and to files; mesh/io.hpp says what is kept.

#include <string>
#include <string_view>

#include "base/mesh.hpp"

namespace wold {

std::string glb_bytes(const TriangleMesh& mesh);

/// Binary (.glb) or text (.gltf, by the extension of `file`); in its folder are the files that it
/// names. Throws Error(input) naming the file.
TriangleMesh parse_gltf(std::string_view bytes, const std::string& file);

}  // namespace wold
