#pragma once
// The finished land as a small height map that travels in a text: 16 bits a sample, differences
// along rows, deflated (zlib), base64.
//
// Stored is, row by row from the south, the difference of each sample from the one before it in
// its row (of the first in a row: from the first in the row before), modulo 2^16, low byte first.

#include <cstdint>
#include <string>
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
  float roughness = 0;  ///< height of features over their size, at the finest the map has

  float at(int i, int j) const {
    const std::size_t k =
        static_cast<std::size_t>(j) * static_cast<std::size_t>(width) + static_cast<std::size_t>(i);
    return heights.low + (heights.high - heights.low) * static_cast<float>(samples[k]) / 65535.0F;
  }
};

/// The land with at most so many samples on a side: each the mean of those it stands for.
HeightMap height_map(const Heightfield& field, int most_samples);

/// Packed for a text.
std::string packed(const HeightMap& map);
/// The samples of a packed map of this size. Throws Error(input) for what is none.
std::vector<std::uint16_t> unpacked(const std::string& text, int width, int height);

}  // namespace wold
