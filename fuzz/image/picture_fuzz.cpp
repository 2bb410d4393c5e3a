#include "../fuzzing.hpp"
#include "image/io.hpp"

// The library keeps its last message for each thread, and does not give it back.
extern "C" const char* __lsan_default_suppressions() {  // NOLINT: the sanitizer's name
  return "leak:libOpenImageIO";
}

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace wold;
  const fuzzing::InputFile file(fuzzing::text_of(data, size), ".png");
  fuzzing::accepts([&] {
    const Picture picture = read_picture(file.path(), Transfer::if_tagged);
    fuzzing::require(picture.image.pixels.size() ==
                     static_cast<std::size_t>(picture.image.width) *
                         static_cast<std::size_t>(picture.image.height) *
                         picture.image.channels.size());
  });
  return 0;
}
