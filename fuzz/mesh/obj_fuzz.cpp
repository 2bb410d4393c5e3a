#include "../fuzzing.hpp"
#include "mesh/obj.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace wold;
  fuzzing::accepts([&] { obj_text(parse_obj(fuzzing::text_of(data, size), "fuzz.obj")); });
  return 0;
}
