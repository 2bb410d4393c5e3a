#include "shaders/library.hpp"

#include <string>
#include <vector>

#include "base/error.hpp"

namespace wold {

std::string_view shader_file(std::string_view path) {
  for (const ShaderFile& file : shader_files())
    if (file.path == path) return file.text;
  std::vector<std::string> paths;
  for (const ShaderFile& file : shader_files()) paths.emplace_back(file.path);
  throw Error(ErrorKind::internal,
              "there is no shader file '" + std::string(path) + "'." + suggestion(path, paths));
}

}  // namespace wold
