#pragma once
// What the fuzz targets share. A target feeds bytes to a reader of files: it may refuse them with a
// wold::Error, and nothing else may happen.

#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "base/error.hpp"

/// What libFuzzer, or fuzz/replay.cpp, calls.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace wold::fuzzing {

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// Reads; true if the bytes were accepted. An Error that says wold has a defect is one.
template <class Read>
bool accepts(const Read& read) {
  try {
    read();
    return true;
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::internal) throw;
    return false;
  }
}

/// Ends the program, as a crash does, unless what must be true is.
inline void require(bool truth) {
  if (!truth) std::abort();
}

/// A file with these bytes, of this process alone, for readers that take only paths.
class InputFile {
 public:
  InputFile(std::string_view bytes, const std::string& extension)
      : path_((std::filesystem::temp_directory_path() /
               ("wold-fuzz-" + std::to_string(::getpid()) + extension))
                  .string()) {
    std::ofstream(path_, std::ios::binary) << bytes;  // write_file would wait for the disk
  }
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;
  ~InputFile() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace wold::fuzzing
