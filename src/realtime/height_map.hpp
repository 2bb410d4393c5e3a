#pragma once
// A map of heights over the land in 16 bits a sample.

#include <cstdint>
#include <vector>

#include "base/parameters.hpp"
#include "terrain/heightfield.hpp"

namespace wold {

struct HeightMap {
  int width = 0;
  int height = 0;
  double cell = 1;                     ///< m
  Range heights;                       ///< m, of 0 and 65535
  std::vector<std::uint16_t> samples;  ///< rows from the south

  float at(int i, int j) const {
    const std::size_t k =
        static_cast<std::size_t>(j) * static_cast<std::size_t>(width) + static_cast<std::size_t>(i);
    return heights.low + (heights.high - heights.low) * static_cast<float>(samples[k]) / 65535.0F;
  }
};

/// Heights in rows from the south.
HeightMap height_map(const std::vector<float>& heights, int width, int height, double cell);
/// The land with at most so many samples on a side: each the mean of those it stands for.
HeightMap height_map(const Heightfield& field, int most_samples);

}  // namespace wold
