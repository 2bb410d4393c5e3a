#include "mesh/ply_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstring>

namespace wold {

namespace {

std::optional<PlyType> type_named(std::string_view name) {
  static const std::map<std::string_view, PlyType> types{
      {"char", PlyType::int8},      {"int8", PlyType::int8},       {"uchar", PlyType::uint8},
      {"uint8", PlyType::uint8},    {"short", PlyType::int16},     {"int16", PlyType::int16},
      {"ushort", PlyType::uint16},  {"uint16", PlyType::uint16},   {"int", PlyType::int32},
      {"int32", PlyType::int32},    {"uint", PlyType::uint32},     {"uint32", PlyType::uint32},
      {"float", PlyType::float32},  {"float32", PlyType::float32}, {"double", PlyType::float64},
      {"float64", PlyType::float64}};
  const auto found = types.find(name);
  return found == types.end() ? std::nullopt : std::optional(found->second);
}

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

using Raw = std::array<char, 8>;

/// `size` bytes, turned over where the file's order is not the machine's.
Raw ordered(const char* bytes, std::size_t size, PlyFormat format) {
  constexpr bool host_is_little = std::endian::native == std::endian::little;
  const bool turned = (format == PlyFormat::little) != host_is_little;
  Raw raw{};
  for (std::size_t k = 0; k < size; ++k) raw[turned ? size - 1 - k : k] = bytes[k];
  return raw;
}

template <class T>
double as(const Raw& raw) {
  T value{};
  std::memcpy(&value, raw.data(), sizeof(T));
  return static_cast<double>(value);
}

double value_of(const Raw& raw, PlyType type) {
  switch (type) {
    case PlyType::int8: return as<std::int8_t>(raw);
    case PlyType::uint8: return as<std::uint8_t>(raw);
    case PlyType::int16: return as<std::int16_t>(raw);
    case PlyType::uint16: return as<std::uint16_t>(raw);
    case PlyType::int32: return as<std::int32_t>(raw);
    case PlyType::uint32: return as<std::uint32_t>(raw);
    case PlyType::float32: return as<float>(raw);
    case PlyType::float64: return as<double>(raw);
  }
  return 0;
}

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  while (true) {
    const auto first = line.find_first_not_of(" \t");
    if (first == std::string_view::npos) return words;
    line.remove_prefix(first);
    const auto end = std::min(line.find_first_of(" \t"), line.size());
    words.push_back(line.substr(0, end));
    line.remove_prefix(end);
  }
}

}  // namespace

std::size_t size_of(PlyType type) {
  constexpr std::array<std::size_t, 8> sizes{1, 1, 2, 2, 4, 4, 4, 8};
  return sizes[static_cast<std::size_t>(type)];
}

std::string ply_bytes_of(double value, PlyType type, PlyFormat format) {
  if (format == PlyFormat::ascii) return fmt::format("{:.9g}", value);
  Raw raw{};
  const auto single = static_cast<float>(value);
  const bool is_double = type == PlyType::float64;
  if (is_double)
    std::memcpy(raw.data(), &value, sizeof(value));
  else
    std::memcpy(raw.data(), &single, sizeof(single));
  const std::size_t size = is_double ? sizeof(value) : sizeof(single);
  return {ordered(raw.data(), size, format).data(), size};
}

const PlyHeader& PlyReader::read_header() {
  if (line() != "ply") fail("a PLY file begins with the line 'ply'");
  std::optional<PlyFormat> format;
  for (;;) {
    const std::string_view text = line();
    const auto words = words_of(text);
    if (words.empty() || words[0] == "obj_info") continue;
    if (words[0] == "end_header") break;
    if (words[0] == "comment") {
      comment(words, text);
    } else if (words[0] == "format" && words.size() >= 2) {
      format = format_named(words[1]);
    } else if (words[0] == "element" && words.size() == 3) {
      header_.elements.push_back({std::string(words[1]), whole_number(words[2]), {}});
    } else if (words[0] == "property" && words.size() >= 3 && !header_.elements.empty()) {
      header_.elements.back().properties.push_back(property(words));
    } else {
      fail(fmt::format("'{}' is not a line of a PLY header", text.substr(0, 40)));
    }
  }
  if (!format) fail("the header names no format");
  header_.format = *format;
  if (*format == PlyFormat::ascii)
    ++where_.line;
  else
    where_.line = 0;  // bytes have no lines
  return header_;
}

void PlyReader::check_count(const PlyElement& element) const {
  // Every thing takes at least a byte.
  if (element.count > rest_.size() && !element.properties.empty())
    fail(fmt::format("{} of element '{}' are announced, but the file ends too early", element.count,
                     element.name));
}

double PlyReader::number(PlyType type) {
  if (header_.format == PlyFormat::ascii) {
    last_ = word();
    double value = 0;
    const auto [end, error] = std::from_chars(last_.data(), last_.data() + last_.size(), value);
    if (error == std::errc::invalid_argument || end != last_.data() + last_.size())
      fail(fmt::format("'{}' is not a number", last_));
    return value;
  }
  const std::size_t size = size_of(type);
  if (rest_.size() < size) fail("the file ends too early");
  last_ = rest_.substr(0, size);
  rest_.remove_prefix(size);
  return value_of(ordered(last_.data(), size, header_.format), type);
}

std::size_t PlyReader::list_size(const PlyProperty& list) {
  const double count = number(*list.count_type);
  if (!(count >= 0) || count > static_cast<double>(rest_.size()))
    fail(fmt::format("a list of {} numbers, but the file ends too early", count));
  return static_cast<std::size_t>(count);
}

std::uint32_t PlyReader::vertex_index(const PlyProperty& list) {
  const double index = number(list.type);
  if (!(index >= 0 && index < 4294967295.0)) fail(fmt::format("a face refers to vertex {}", index));
  return static_cast<std::uint32_t>(index);
}

void PlyReader::skip(const PlyProperty& property) {
  const std::size_t count = property.count_type ? list_size(property) : 1;
  for (std::size_t k = 0; k < count; ++k) number(property.type);
}

std::string_view PlyReader::line() {
  if (rest_.empty()) fail("the file ends too early");
  ++where_.line;
  const auto end = std::min(rest_.find('\n'), rest_.size());
  std::string_view text = rest_.substr(0, end);
  rest_.remove_prefix(std::min(end + 1, rest_.size()));
  if (!text.empty() && text.back() == '\r') text.remove_suffix(1);
  return text;
}

std::string_view PlyReader::word() {
  while (!rest_.empty() && is_blank(rest_.front())) {
    if (rest_.front() == '\n') ++where_.line;
    rest_.remove_prefix(1);
  }
  std::size_t size = 0;
  while (size < rest_.size() && !is_blank(rest_[size])) ++size;
  if (size == 0) fail("the file ends too early");
  const std::string_view text = rest_.substr(0, size);
  rest_.remove_prefix(size);
  return text;
}

void PlyReader::comment(const std::vector<std::string_view>& words, std::string_view line) {
  if (words.size() < 4 || words[1] != "material") return;
  const auto name = static_cast<std::size_t>(words[3].data() - line.data());
  header_.materials[static_cast<long long>(whole_number(words[2]))] =
      std::string(line.substr(name));
}

PlyFormat PlyReader::format_named(std::string_view name) const {
  if (name == "ascii") return PlyFormat::ascii;
  if (name == "binary_little_endian") return PlyFormat::little;
  if (name == "binary_big_endian") return PlyFormat::big;
  fail(fmt::format("unknown format '{}'; known are ascii, binary_little_endian, binary_big_endian",
                   name));
}

std::uint64_t PlyReader::whole_number(std::string_view word) const {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size() || value > 0xffffffffU)
    fail(fmt::format("'{}' is not a number of things", word));
  return value;
}

PlyProperty PlyReader::property(const std::vector<std::string_view>& words) const {
  const bool list = words[1] == "list";
  if (words.size() != (list ? 5U : 3U)) fail("a property has a type and a name");
  const auto type = [&](std::string_view name) {
    const auto known = type_named(name);
    if (!known) fail(fmt::format("unknown type '{}'", name));
    return *known;
  };
  PlyProperty p;
  p.name = std::string(words.back());
  if (list) p.count_type = type(words[2]);
  p.type = type(words[list ? 3 : 1]);
  return p;
}

}  // namespace wold
