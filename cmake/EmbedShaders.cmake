# Run as a script: writes OUTPUT, a source file that holds every GLSL file below FOLDER as text.
#   cmake -D FOLDER=src/shaders -D OUTPUT=shader_files.cpp -P EmbedShaders.cmake
file(GLOB_RECURSE paths RELATIVE ${FOLDER} ${FOLDER}/*.glsl)
list(SORT paths)
set(entries "")
foreach(path IN LISTS paths)
  # Semicolons would fall apart in a CMake list: the text is one string, never a list.
  file(READ ${FOLDER}/${path} text)
  string(APPEND entries "    {\"${path}\", R\"wold_glsl(${text})wold_glsl\"},\n")
endforeach()
file(WRITE ${OUTPUT}.new "#include \"shaders/library.hpp\"

#include <array>

namespace wold {

namespace {

constexpr auto files = std::to_array<ShaderFile>({
${entries}});

}  // namespace

std::span<const ShaderFile> shader_files() {
  return files;
}

}  // namespace wold
")
file(RENAME ${OUTPUT}.new ${OUTPUT})
