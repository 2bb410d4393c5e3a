#include "mesh/obj_syntax.hpp"

#include <algorithm>
#include <limits>

namespace wold {

bool ObjLines::next() {
  where_.line += lines_taken_;
  lines_taken_ = 1;
  if (rest_.empty()) return false;
  std::size_t begin = 0;
  std::size_t end = 0;
  for (;;) {
    end = std::min(rest_.find('\n', begin), rest_.size());
    const std::string_view line = rest_.substr(begin, end - begin);
    const std::string_view content = line.substr(0, line.find_last_not_of('\r') + 1);
    const bool goes_on = content.ends_with('\\') && content.find('#') == std::string_view::npos &&
                         end < rest_.size();
    if (!goes_on) break;
    begin = end + 1;
    ++lines_taken_;
  }
  line_ = rest_.substr(0, end);
  line_ = line_.substr(0, line_.find('#'));
  rest_.remove_prefix(std::min(end + 1, rest_.size()));
  return true;
}

std::string_view ObjLines::trimmed(std::string_view text) {
  constexpr std::string_view blank = " \t\r\n";
  const auto first = text.find_first_not_of(blank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blank) - first + 1);
}

std::string_view ObjLines::take_word(std::string_view& line) {
  constexpr std::string_view blank = " \t\r\n\\";
  line.remove_prefix(std::min(line.find_first_not_of(blank), line.size()));
  const std::string_view word = line.substr(0, line.find_first_of(blank));
  line.remove_prefix(word.size());
  return word;
}

ObjLines::Corner ObjLines::corner(std::string_view word,
                                  const std::array<std::size_t, 3>& counts) const {
  Corner corner;
  std::string_view rest = word;
  for (std::size_t k = 0; k < 3 && !rest.empty(); ++k) {
    const auto end = std::min(rest.find('/'), rest.size());
    const std::string_view digits = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    if (digits.empty() && k > 0) continue;
    corner.index[k] = index(digits, word, counts[k]);
    if (k == 2) corner.normal = digits;
  }
  if (!rest.empty()) fail(fmt::format("'{}' is not a corner like 1, 1/2, 1//3 or 1/2/3", word));
  return corner;
}

int ObjLines::index(std::string_view digits, std::string_view word, std::size_t count) const {
  long long value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc() || end != digits.data() + digits.size())
    fail(fmt::format("'{}' is not a corner like 1, 1/2, 1//3 or 1/2/3", word));
  if (value == std::numeric_limits<long long>::min()) value = 0;  // has no opposite
  const long long from_zero = value < 0 ? static_cast<long long>(count) + value : value - 1;
  if (from_zero < 0 || from_zero >= static_cast<long long>(count))
    fail(fmt::format("'{}' refers to number {}, but there are {} before this line", word, value,
                     count));
  return static_cast<int>(from_zero);
}

}  // namespace wold
