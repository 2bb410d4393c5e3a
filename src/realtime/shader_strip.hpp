#pragma once
// A shader without what nothing uses: for texts that people read and paste.

#include <string>
#include <string_view>

namespace wold {

/// GLSL without the functions, structs, constants and macros that cannot be reached from the
/// function `root`, and without the comments that stand right above them. Preprocessor
/// conditionals and uniforms are kept; a name used by any kept text is kept in all its overloads.
std::string stripped_shader(std::string_view text, std::string_view root);

}  // namespace wold
