#pragma once
// Options that commands which make pictures have in common.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "base/vec.hpp"

namespace wold {

/// A whole number, and nothing else.
std::optional<std::uint32_t> whole_number(std::string_view text);

/// "1280x720". Throws Error(usage).
IVec2 parse_size(const std::string& text);
/// The same as an override of the scene. Throws Error(usage).
std::string size_override(const std::string& text);

}  // namespace wold
