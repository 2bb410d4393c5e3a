#include <cstring>

#include "../fuzzing.hpp"
#include "image/io.hpp"

// The first eight bytes are the width and the height that the caller asks for.
int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace wold;
  int width = 0;
  int height = 0;
  if (size < sizeof(width) + sizeof(height)) return 0;
  std::memcpy(&width, data, sizeof(width));
  std::memcpy(&height, data + sizeof(width), sizeof(height));
  const std::size_t head = sizeof(width) + sizeof(height);
  const fuzzing::InputFile file(fuzzing::text_of(data + head, size - head), ".r16");
  fuzzing::accepts([&] { read_raw16(file.path(), width, height, {ByteOrder::big, true}); });
  fuzzing::accepts([&] { read_raw16(file.path()); });
  return 0;
}
