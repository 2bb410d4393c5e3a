#pragma once
// Memory: how much is free, to refuse before the work what will not fit.

#include <cstdint>
#include <string>

namespace wold {

/// Bytes that could be allocated now without swapping, or 0 where the system does not tell.
std::uint64_t available_memory();

/// "512 MB", "1.3 GB".
std::string memory_text(double bytes);

}  // namespace wold
