#include "../fuzzing.hpp"
#include "plants/plant.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace wold;
  fuzzing::accepts([&] {
    const Plant plant = parse_plant(fuzzing::text_of(data, size), "fuzz.lsys");
    // Growing takes what the file asks for; a few modules show whether it can be grown at all.
    Progress progress;
    grow(plant, {.seed = 1, .iterations = 3, .max_modules = 2000}, progress);
  });
  return 0;
}
