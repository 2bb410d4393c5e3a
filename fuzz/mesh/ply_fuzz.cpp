#include "../fuzzing.hpp"
#include "mesh/ply.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace wold;
  fuzzing::accepts([&] { ply_bytes(parse_ply(fuzzing::text_of(data, size), "fuzz.ply")); });
  return 0;
}
