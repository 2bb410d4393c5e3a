#pragma once
// The GLSL files of this folder, built into the library: small files of functions, named as their
// C++ twins ("noise/lattice.glsl" for noise/lattice.hpp), which others bring in with
// #include "noise/lattice.glsl". They keep to what GLSL 3.30 and GLSL ES 3.00 share.

#include <span>
#include <string_view>

namespace wold {

struct ShaderFile {
  std::string_view path;  ///< from src/shaders, "noise/lattice.glsl"
  std::string_view text;
};

/// All files, by path.
std::span<const ShaderFile> shader_files();

/// The text of one. Throws Error(internal) with the nearest path if there is none.
std::string_view shader_file(std::string_view path);

}  // namespace wold
