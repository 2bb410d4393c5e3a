#pragma once
// Stanford PLY from and to bytes; mesh/io.hpp says what is kept.

#include <string>
#include <string_view>

#include "base/mesh.hpp"

namespace wold {

std::string ply_bytes(const TriangleMesh& mesh);

/// `file` is for messages. Throws Error(input) with the file and, in its text, the line.
TriangleMesh parse_ply(std::string_view bytes, const std::string& file);

}  // namespace wold
