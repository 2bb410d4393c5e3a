#pragma once
// Samples of a map as a text: differences along rows, deflated (zlib), base64.
//
// Stored is, row by row, the difference of each sample from the one before it in its row (of the
// first in a row: from the first in the row before), modulo 2^16 or 2^8, low byte first.

#include <cstdint>
#include <string>
#include <vector>

namespace wold {

std::string packed(const std::vector<std::uint16_t>& samples, int width);
std::string packed(const std::vector<std::uint8_t>& samples, int width);

/// The samples of a packed map of this size. Throws Error(input) for what is none.
std::vector<std::uint16_t> unpacked_words(const std::string& text, int width, int height);
std::vector<std::uint8_t> unpacked_bytes(const std::string& text, int width, int height);

}  // namespace wold
