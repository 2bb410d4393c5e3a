#include "../fuzzing.hpp"
#include "mesh/gltf.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace wold;
  fuzzing::accepts([&] { glb_bytes(parse_gltf(fuzzing::text_of(data, size), "fuzz.gltf")); });
  return 0;
}
