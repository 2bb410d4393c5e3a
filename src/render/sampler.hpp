#pragma once
// Random numbers for light paths: Owen-scrambled Sobol' points.
//
// The value of a sample depends on (seed, pixel, absolute sample index, dimension) alone, so a
// picture is the same for any number of threads, and any range of samples can be traced anywhere
// and added up.
//
// Dimensions come in pairs. Each pair is the (0,2)-sequence of Sobol', its index shuffled and its
// digits scrambled by hash-based Owen scrambling (Burley, "Practical Hash-based Owen Scrambling",
// JCGT 9(4), 2020, with the improved Laine-Karras hash of Vegdahl). Pairs are padded, independent
// of each other.

#include <cstdint>

#include "base/vec.hpp"

namespace wold {

/// Point `index` of the two-dimensional Sobol' sequence, as 32-bit fixed-point fractions.
struct SobolPoint {
  std::uint32_t x = 0;
  std::uint32_t y = 0;
};
SobolPoint sobol_point(std::uint32_t index);

/// Owen scrambling of a 32-bit fixed-point fraction: a random nested permutation of its digits.
std::uint32_t owen_scramble(std::uint32_t x, std::uint32_t seed);

class Sampler {
 public:
  Sampler(std::uint64_t seed, int pixel_x, int pixel_y, std::uint32_t index);

  /// The next pair of dimensions, in [0, 1)².
  Vec2 next();
  /// Continues at the given pair, so that what one bounce draws does not shift the next bounce's
  /// dimensions.
  void skip_to(std::uint32_t pair) { pair_ = pair; }

 private:
  std::uint32_t pixel_seed_;
  std::uint32_t index_;
  std::uint32_t pair_ = 0;
};

}  // namespace wold
