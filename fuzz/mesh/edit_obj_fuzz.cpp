#include "editing.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return wold::fuzzing::edit(wold::fuzzing::text_of(data, size), "fuzz.obj");
}
