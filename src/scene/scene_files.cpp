#include <fmt/format.h>

#include <system_error>

#include "scene/scene.hpp"

namespace wold {

namespace {

namespace fs = std::filesystem;

/// Where plants/ is when wold runs from its build folder, or from a prefix with bin/ and
/// share/wold/.
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
  std::vector<fs::path> places{wanted};
  if (wanted.is_relative()) {
    // scenes/forest.toml names plants/birch.lsys, which is beside scenes/, not in it.
    places = {folder / wanted, folder / ".." / wanted, wanted};
    for (const fs::path& data : data_folders()) places.push_back(data / wanted);
  }
  for (const fs::path& place : places)
    if (fs::is_regular_file(place, ignored)) return place.lexically_normal();
  throw Error(
      ErrorKind::io,
      fmt::format("there is no file '{}', neither beside the scene nor with wold's own files",
                  path));
}

}  // namespace wold
