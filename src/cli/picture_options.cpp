#include "cli/picture_options.hpp"

#include <fmt/format.h>

#include <charconv>

#include "base/error.hpp"

namespace wold {

std::optional<std::uint32_t> whole_number(std::string_view text) {
  std::uint32_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

IVec2 parse_size(const std::string& text) {
  const auto x = text.find_first_of("xX");
  const auto width = x == std::string::npos ? std::nullopt : whole_number(text.substr(0, x));
  const auto height = x == std::string::npos ? std::nullopt : whole_number(text.substr(x + 1));
  const auto good = [](std::optional<std::uint32_t> n) { return n && *n >= 1 && *n <= 65536; };
  if (!good(width) || !good(height))
    throw Error(ErrorKind::usage,
                fmt::format("'--size {}' must be width x height in pixels, such as 1280x720, each "
                            "1 to 65536",
                            text));
  return {static_cast<int>(*width), static_cast<int>(*height)};
}

std::string size_override(const std::string& text) {
  const IVec2 size = parse_size(text);
  return fmt::format("render.size=[{}, {}]", size.x, size.y);
}

}  // namespace wold
