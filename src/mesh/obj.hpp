#pragma once
// Wavefront OBJ from and to text; mesh/io.hpp says what is kept.

#include <string>
#include <string_view>

#include "base/mesh.hpp"

namespace wold {

std::string obj_text(const TriangleMesh& mesh);

/// `file` is for messages. Throws Error(input) with file and line.
TriangleMesh parse_obj(std::string_view text, const std::string& file);

}  // namespace wold
