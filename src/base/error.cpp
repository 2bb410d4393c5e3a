#include "base/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <vector>

namespace wold {

namespace {

std::string joined(const SourceLocation& location, const std::string& message) {
  return location.known() ? fmt::format("{}: {}", location.text(), message) : message;
}

}  // namespace

std::string SourceLocation::text() const {
  if (line <= 0) return file;
  if (column <= 0) return fmt::format("{}:{}", file, line);
  return fmt::format("{}:{}:{}", file, line, column);
}

Error::Error(ErrorKind kind, std::string message, SourceLocation location)
    : std::runtime_error(joined(location, message)),
      kind_(kind),
      message_(std::move(message)),
      location_(std::move(location)) {}

Error Error::at(const SourceLocation& location) const {
  return location_.known() ? *this : Error(kind_, message_, location);
}

int edit_distance(std::string_view a, std::string_view b) {
  const std::size_t columns = b.size() + 1;
  std::vector<int> before_last(columns);
  std::vector<int> last(columns);
  std::vector<int> current(columns);
  std::iota(last.begin(), last.end(), 0);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    current[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const int replaced = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      current[j] = std::min({last[j] + 1, current[j - 1] + 1, replaced});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) current[j] = std::min(current[j], before_last[j - 2] + 1);
    }
    std::swap(before_last, last);
    std::swap(last, current);
  }
  return last[b.size()];
}

std::string closest_name(std::string_view word, std::span<const std::string> candidates) {
  std::string best;
  int best_distance = 1 + std::max<int>(1, static_cast<int>(word.size()) / 3);
  for (const std::string& candidate : candidates) {
    const int distance = edit_distance(word, candidate);
    if (distance < best_distance) {
      best_distance = distance;
      best = candidate;
    }
  }
  return best;
}

std::string suggestion(std::string_view word, std::span<const std::string> candidates) {
  if (candidates.empty()) return {};
  const std::string near = closest_name(word, candidates);
  if (!near.empty()) return fmt::format(" Did you mean '{}'?", near);
  return fmt::format(" Known: {}.", fmt::join(candidates, ", "));
}

}  // namespace wold
