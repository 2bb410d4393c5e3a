#include "cli/delivery.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <new>

#include "base/error.hpp"

namespace wold {

namespace {

namespace fs = std::filesystem;

/// The first of NAME.x, NAME-2.x, NAME-3.x … in the folder that is not there yet.
fs::path free_path(const fs::path& folder, const fs::path& name) {
  std::error_code ignored;
  fs::path path = folder / name;
  for (int k = 2; fs::exists(fs::symlink_status(path, ignored)); ++k)
    path = folder / fmt::format("{}-{}{}", name.stem().string(), k, name.extension().string());
  return path;
}

/// Where a file may go that cannot be written at `path`.
std::vector<fs::path> refuges(const fs::path& path) {
  std::error_code ignored;
  const fs::path wanted = fs::absolute(path, ignored).lexically_normal();
  const fs::path name = path.has_filename() ? path.filename() : path.parent_path().filename();
  std::vector<fs::path> list;
  for (const fs::path& folder : {fs::current_path(ignored), fs::temp_directory_path(ignored)}) {
    if (folder.empty()) continue;
    const fs::path refuge = free_path(folder, name);
    if (refuge != wanted) list.push_back(refuge);
  }
  return list;
}

/// What went wrong; empty if nothing.
std::string failure_of(const fs::path& path, const std::function<void(const std::string&)>& write) {
  try {
    write(path.string());
  } catch (const std::bad_alloc&) {
    return fmt::format("cannot write '{}': out of memory", path.string());
  } catch (const std::exception& error) {
    return error.what();
  }
  return {};
}

}  // namespace

std::string Delivery::write(const std::string& path,
                            const std::function<void(const std::string& path)>& write) {
  const std::string failure = failure_of(path, write);
  if (failure.empty()) return path;
  for (const fs::path& refuge : refuges(path)) {
    if (!failure_of(refuge, write).empty()) continue;
    failures_.push_back(fmt::format("{}; saved as '{}' instead", failure, refuge.string()));
    return refuge.string();
  }
  failures_.push_back(failure);
  return {};
}

void Delivery::check() const {
  if (!complete()) throw Error(ErrorKind::io, fmt::format("{}", fmt::join(failures_, "; ")));
}

}  // namespace wold
