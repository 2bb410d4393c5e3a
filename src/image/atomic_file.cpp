#include "image/atomic_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <system_error>
#include <utility>
#include <vector>

#include "base/error.hpp"

namespace wold {

namespace {

namespace fs = std::filesystem;

Error cannot_write(const std::string& path, const std::string& why) {
  return {ErrorKind::io, fmt::format("cannot write '{}': {}", path, why)};
}

/// A file descriptor that is closed at the end of its scope.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  int number() const { return number_; }
  bool valid() const { return number_ >= 0; }
  /// Closes now; some file systems report a failed write only here.
  bool close() { return ::close(std::exchange(number_, -1)) == 0; }

 private:
  int number_;
};

/// A symbolic link stays a link: what it points to is replaced.
fs::path followed(const std::string& path) {
  std::error_code ignored;
  if (!fs::is_symlink(path, ignored)) return path;
  const fs::path target = fs::weakly_canonical(path, ignored);
  return target.empty() ? fs::path(path) : target;
}

fs::path folder_of(const fs::path& path) {
  const fs::path folder = path.parent_path();
  return folder.empty() ? fs::path(".") : folder;
}

/// "maps" of "maps/".
fs::path bare(const fs::path& folder) {
  return folder.has_filename() || folder == folder.root_path() ? folder : folder.parent_path();
}

/// Of the folders on the way to this one, and it; the innermost first.
std::vector<fs::path> missing_folders(const fs::path& folder) {
  std::vector<fs::path> list;
  std::error_code ignored;
  for (fs::path p = bare(folder); p != folder_of(p) && !fs::exists(p, ignored); p = folder_of(p))
    list.push_back(p);
  return list;
}

/// An empty new file beside `path`; removes it at the end unless it took its place.
class Temporary {
 public:
  Temporary(const std::string& path, const fs::path& target) : path_(path), target_(target) {
    const fs::path folder = folder_of(target);
    for (int attempt = 0; attempt < 1000; ++attempt) {
      const std::string name = fmt::format(".{}.{}-{}{}", target.stem().string(), ::getpid(),
                                           attempt, target.extension().string());
      name_ = (folder / name).string();
      const Descriptor file(::open(name_.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666));
      if (file.valid()) return;
      if (errno != EEXIST) break;
    }
    const int error = errno;
    name_.clear();
    throw cannot_write(path, io_reason(error));
  }
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;
  ~Temporary() {
    if (!name_.empty()) ::unlink(name_.c_str());
  }

  const std::string& name() const { return name_; }

  void take_place() {
    struct stat old {};
    if (::stat(target_.c_str(), &old) == 0) ::chmod(name_.c_str(), old.st_mode & 07777U);
    flush();
    if (::rename(name_.c_str(), target_.c_str()) != 0) throw cannot_write(path_, io_reason(errno));
    name_.clear();
    const Descriptor folder(::open(folder_of(target_).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (folder.valid()) ::fsync(folder.number());  // not every file system can: no error
  }

 private:
  void flush() {
    Descriptor file(::open(name_.c_str(), O_RDONLY | O_CLOEXEC));
    const bool flushed = file.valid() && (::fsync(file.number()) == 0 || errno == EINVAL);
    if (!flushed || !file.close()) throw cannot_write(path_, io_reason(errno));
  }

  std::string path_;  // as the caller wrote it, for messages
  fs::path target_;
  std::string name_;
};

void write_all(const std::string& path, const std::string& temporary, std::string_view bytes) {
  Descriptor file(::open(temporary.c_str(), O_WRONLY | O_TRUNC | O_CLOEXEC));
  if (!file.valid()) throw cannot_write(path, io_reason(errno));
  while (!bytes.empty()) {
    const ssize_t written = ::write(file.number(), bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) throw cannot_write(path, io_reason(errno));
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  if (!file.close()) throw cannot_write(path, io_reason(errno));
}

}  // namespace

std::string io_reason(int error) {
  switch (error) {
    case ENOSPC: return "the disk is full";
    case EDQUOT: return "the disk quota is used up";
    case EROFS: return "the disk is read-only";
    case EFBIG: return "the file would be larger than allowed";
    case EACCES:
    case EPERM: return "permission denied";
    default: return std::generic_category().message(error);
  }
}

void write_atomically(const std::string& path,
                      const std::function<void(const std::string& temporary)>& write) {
  check_writable(path);
  Temporary temporary(path, followed(path));
  write(temporary.name());
  temporary.take_place();
}

void write_file(const std::string& path, std::string_view bytes) {
  write_atomically(path, [&](const std::string& temporary) { write_all(path, temporary, bytes); });
}

std::string read_file(const std::string& path) {
  std::error_code ignored;
  if (fs::is_directory(path, ignored))
    throw Error(ErrorKind::io, fmt::format("cannot read '{}': it is a folder, not a file", path));
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (!file.valid()) {
    const std::string why = errno == ENOENT ? "there is no such file" : io_reason(errno);
    throw Error(ErrorKind::io, fmt::format("cannot read '{}': {}", path, why));
  }
  std::string bytes;
  const auto size = fs::file_size(path, ignored);
  if (!ignored) bytes.reserve(size);
  std::string block(1U << 16U, '\0');
  for (;;) {
    const ssize_t count = ::read(file.number(), block.data(), block.size());
    if (count == 0) return bytes;
    if (count < 0 && errno == EINTR) continue;
    if (count < 0)
      throw Error(ErrorKind::io, fmt::format("cannot read '{}': {}", path, io_reason(errno)));
    bytes.append(block.data(), static_cast<std::size_t>(count));
  }
}

std::string extension_of(const std::string& path) {
  std::string extension = fs::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return extension;
}

void write_folder(const std::string& folder, const std::function<void()>& write) {
  const std::vector<fs::path> made = missing_folders(folder);
  const auto take_away = [&] {
    std::error_code ignored;
    for (const fs::path& p : made) fs::remove(p, ignored);  // leaves what is not empty
  };
  std::error_code failure;
  fs::create_directories(bare(folder), failure);
  if (failure) {
    const std::string why = io_reason(failure.value());
    take_away();
    throw Error(ErrorKind::io, fmt::format("cannot make the folder '{}': {}", folder, why));
  }
  try {
    write();
  } catch (...) {
    take_away();
    throw;
  }
}

void check_folder_writable(const std::string& folder) {
  const auto fail = [&](const std::string& why) {
    throw Error(ErrorKind::io, fmt::format("cannot write into '{}': {}", folder, why));
  };
  const std::vector<fs::path> missing = missing_folders(folder);
  const fs::path there = missing.empty() ? bare(folder) : folder_of(missing.back());
  std::error_code ignored;
  if (!fs::is_directory(there, ignored))
    fail(missing.empty() ? "it is no folder" : fmt::format("'{}' is no folder", there.string()));
  if (::access(there.c_str(), W_OK | X_OK) != 0)
    fail(fmt::format("no new file may be made in the folder '{}' ({})", there.string(),
                     io_reason(errno)));
}

void check_writable(const std::string& path, std::span<const std::string> extensions) {
  if (path.empty()) throw Error(ErrorKind::usage, "the name of the file to write is empty");
  const std::string extension = extension_of(path);
  if (!extensions.empty() &&
      std::find(extensions.begin(), extensions.end(), extension) == extensions.end())
    throw Error(ErrorKind::usage,
                fmt::format("cannot write '{}': {}; known are {}", path,
                            extension.empty() ? "its name has no extension"
                                              : fmt::format("unknown extension '{}'", extension),
                            fmt::join(extensions, ", ")));
  const fs::path target = followed(path);
  const fs::path folder = folder_of(target);
  std::error_code ignored;
  if (!fs::exists(folder, ignored))
    throw cannot_write(path, fmt::format("the folder '{}' does not exist", folder.string()));
  if (!fs::is_directory(folder, ignored))
    throw cannot_write(path, fmt::format("'{}' is not a folder", folder.string()));
  if (fs::is_directory(target, ignored))
    throw cannot_write(path, "it is a folder; add a file name");
  if (fs::exists(target, ignored) && !fs::is_regular_file(target, ignored))
    throw cannot_write(path, "it is not a regular file");
  if (::access(folder.c_str(), W_OK | X_OK) != 0)
    throw cannot_write(path, fmt::format("no new file may be made in the folder '{}' ({})",
                                         folder.string(), io_reason(errno)));
}

}  // namespace wold
