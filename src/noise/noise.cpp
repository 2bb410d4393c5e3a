#include "noise/noise.hpp"

#include "noise/lattice.hpp"
#include "noise/noise_cell.hpp"

namespace wold {

Sample2 value_noise(DVec2 p, std::uint32_t seed) {
  return noise_cell::value_noise(p, lattice_key(seed));
}

Sample2 gradient_noise(DVec2 p, std::uint32_t seed) {
  return noise_cell::gradient_noise(p, lattice_key(seed));
}

Sample3 value_noise(DVec3 p, std::uint32_t seed) {
  return noise_cell::value_noise(p, lattice_key(seed));
}

Sample3 gradient_noise(DVec3 p, std::uint32_t seed) {
  return noise_cell::gradient_noise(p, lattice_key(seed));
}

}  // namespace wold
