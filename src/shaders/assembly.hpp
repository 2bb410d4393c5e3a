#pragma once
// From a shader file to the text that a driver compiles: #version, #defines, and each included file
// once, where it is first asked for. #line keeps count of files and lines, so that a driver's log
// can be told in the names of our files.

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace wold {

enum class ShaderDialect {
  gl_430,  ///< OpenGL 4.3 core, with compute shaders
  gl_330,  ///< OpenGL 3.3 core
  es_300   ///< OpenGL ES 3.0 and WebGL 2
};

/// #define NAME VALUE
struct ShaderDefine {
  std::string name;
  std::string value = {};
};

struct ShaderText {
  std::string name;                ///< for messages
  std::string text;                ///< to compile
  std::vector<std::string> files;  ///< by the number that #line gives them
};

/// `path` in src/shaders. Throws Error(internal) for an include that is not there, with the file
/// and line that asks for it.
ShaderText assemble_shader(std::string_view path, ShaderDialect dialect,
                           std::span<const ShaderDefine> defines = {});

/// The same for a text of our own, which may include files.
ShaderText assemble_shader_text(std::string name, std::string_view body, ShaderDialect dialect,
                                std::span<const ShaderDefine> defines = {});

/// A text with every include in its place and nothing added, neither #version nor #line: for
/// export.
std::string flatten_shader(std::string_view body);

/// A driver's log with "noise/lattice.glsl:12" where the driver wrote 3:12(5) (Mesa), 3(12)
/// (NVIDIA) or ERROR: 3:12 (ANGLE, glslang).
std::string readable_shader_log(std::string_view log, const ShaderText& shader);

}  // namespace wold
