#pragma once
// The values that a parameter may take, as they come from a file or a command line.

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace wold {

/// A moment: local date and time and its offset from UTC. Written as in RFC 3339,
/// `2026-06-21T18:30:00+02:00`.
struct DateTime {
  int year = 2026;
  int month = 6;
  int day = 21;
  int hour = 12;
  int minute = 0;
  double second = 0;
  int offset_minutes = 0;  ///< local time minus UTC

  friend bool operator==(const DateTime&, const DateTime&) = default;
};

/// Names with a weight each: `{ birch = 3, fern = 8 }`.
using Weights = std::vector<std::pair<std::string, double>>;

using Value = std::variant<bool, std::int64_t, double, std::string, std::vector<double>, DateTime,
                           Weights, std::vector<std::string>>;

/// "true", "an integer", "a list of 2 numbers": what kind of value this is, for messages.
std::string kind_text(const Value& value);

/// The value as TOML source.
std::string to_text(const Value& value);
std::string to_text(const DateTime& time);

/// Reads RFC 3339 (seconds and offset optional; no offset means UTC). Throws Error(input).
DateTime parse_date_time(std::string_view text);

}  // namespace wold
