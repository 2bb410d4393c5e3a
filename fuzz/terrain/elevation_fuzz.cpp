#include <array>

#include "../fuzzing.hpp"
#include "terrain/elevation.hpp"

// The first byte chooses the extension.
int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace wold;
  if (size == 0) return 0;
  constexpr std::array<const char*, 4> extensions{".asc", ".tif", ".hgt", ".r16"};
  const fuzzing::InputFile file(fuzzing::text_of(data + 1, size - 1), extensions[data[0] % 4]);
  fuzzing::accepts([&] { read_elevation(file.path()); });
  return 0;
}
