#pragma once
// Receivers of a row of samples by the steepest slope, with some chance, and how far the way to the
// receiver lies off the slope of the ground.
//
// A receiver lies in one of 8 directions, the slope of the ground in any: a plane as steep as its
// talus angle would be too steep along none of the 8 and cut back along no other, so cones became
// octagons. So the slope that is allowed towards the receiver is tan(talus) cos(angle between the
// way there and the slope by Sobel's differences).

#include <array>
#include <cstdint>

namespace wold {

/// One inner row of a grid; pointers to its first sample.
struct DirectionRow {
  const float* height = nullptr;
  std::array<const float*, 8> nearness{};  ///< null: the distances of the grid
  int width = 0;
  int row = 0;
  std::uint32_t key = 0;  ///< of the step's random numbers
  float wandering = 0;    ///< slopes are times a random number in 1 ± wandering / 2
};

/// A random factor of a sample's slope to neighbour d.
float slope_chance(const DirectionRow& row, int i, int d);

/// Fills `direction` and `cosine` for samples 1 to width - 2.
void find_directions(const DirectionRow& row, std::uint8_t* direction, float* cosine);

}  // namespace wold
