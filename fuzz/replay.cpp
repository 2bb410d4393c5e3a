// Runs a fuzz target on files, where libFuzzer is not there: TARGET FILE|FOLDER…
// A crash, a hang or an exception that leaves the target is a failure.

#include <cstdio>
#include <filesystem>
#include <vector>

#include "fuzzing.hpp"
#include "image/atomic_file.hpp"

namespace {

void replay(const std::filesystem::path& file) {
  std::printf("%s\n", file.string().c_str());
  std::fflush(stdout);
  const std::string bytes = wold::read_file(file.string());
  // At the end of a block of its own, so that a sanitizer sees what reads beyond.
  const std::vector<std::uint8_t> data(bytes.begin(), bytes.end());
  LLVMFuzzerTestOneInput(data.data(), data.size());
}

}  // namespace

int main(int count, char** arguments) {
  int files = 0;
  for (int k = 1; k < count; ++k) {
    const std::filesystem::path path(arguments[k]);
    if (!std::filesystem::is_directory(path)) {
      replay(path);
      ++files;
      continue;
    }
    for (const auto& entry : std::filesystem::directory_iterator(path)) {
      replay(entry.path());
      ++files;
    }
  }
  if (files == 0) std::fprintf(stderr, "nothing to replay\n");
  return files > 0 ? 0 : 1;
}
