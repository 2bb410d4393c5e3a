#include <fmt/format.h>

#include <system_error>

#include "scene/scene.hpp"

namespace wold {

namespace {

namespace fs = std::filesystem;

/// Where plants/ and scenes/ are when wold runs from its build folder, and when it is installed.
std::vector<fs::path> data_folders() {
  std::error_code ignored;
  const fs::path program = fs::read_symlink("/proc/self/exe", ignored);
  if (program.empty()) return {};
  const fs::path bin = program.parent_path();
  return {bin / ".." / "share" / "wold", bin / ".." / ".." / ".."};
}

}  // namespace

fs::path find_scene_file(const std::string& path, const fs::path& folder) {
  std::error_code ignored;
  const fs::path wanted(path);
  std::vector<fs::path> places{wanted.is_absolute() ? wanted : folder / wanted};
  if (wanted.is_relative()) {
    // scenes/forest.toml names plants/birch.lsys: beside scenes/, not in it.
    if (folder.has_parent_path()) places.push_back(folder.parent_path() / wanted);
    if (!folder.has_parent_path()) places.push_back(wanted);
    for (const fs::path& data : data_folders()) places.push_back(data / wanted);
  }
  for (const fs::path& place : places)
    if (fs::is_regular_file(place, ignored)) return place.lexically_normal();
  throw Error(ErrorKind::io, fmt::format("there is no file '{}'; looked for {}", path,
                                         places.front().lexically_normal().string()));
}

}  // namespace wold
