#pragma once
// Options that commands which make pictures have in common.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace wold {

/// A whole number, and nothing else.
std::optional<std::uint32_t> whole_number(std::string_view text);

/// "1280x720" as an override of the scene. Throws Error(usage).
std::string size_override(const std::string& text);

}  // namespace wold
