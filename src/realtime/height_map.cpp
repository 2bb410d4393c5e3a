#include "realtime/height_map.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "base/error.hpp"

namespace wold {

namespace {

constexpr std::string_view alphabet =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

std::string base64(const std::vector<unsigned char>& bytes) {
  std::string text;
  for (std::size_t k = 0; k < bytes.size(); k += 3) {
    const std::size_t left = std::min<std::size_t>(3, bytes.size() - k);
    std::uint32_t group = 0;
    for (std::size_t i = 0; i < 3; ++i) group = group << 8U | (i < left ? bytes[k + i] : 0U);
    for (std::size_t i = 0; i < 4; ++i)
      text += i <= left ? alphabet[group >> (18 - 6 * i) & 63U] : '=';
  }
  return text;
}

std::vector<unsigned char> bytes_of(const std::string& text) {
  std::vector<unsigned char> bytes;
  std::uint32_t group = 0;
  int bits = 0;
  for (const char c : text) {
    if (c == '=') break;
    const std::size_t digit = alphabet.find(c);
    if (digit == std::string_view::npos) throw Error(ErrorKind::input, "no base64");
    group = group << 6U | static_cast<std::uint32_t>(digit);
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes.push_back(static_cast<unsigned char>(group >> static_cast<unsigned>(bits) & 255U));
  }
  return bytes;
}

/// The mean height of the field about a place, over a square of this many samples.
float mean_about(const Heightfield& field, double x, double y, double samples) {
  const auto low = [](double c, double half) { return static_cast<int>(std::ceil(c - half)); };
  const auto high = [](double c, double half) { return static_cast<int>(std::floor(c + half)); };
  const double half = 0.5 * samples;
  if (half < 0.75) return height_at(field, field.origin + field.cell * DVec2(x, y));
  double sum = 0;
  int count = 0;
  for (int j = low(y, half); j <= high(y, half); ++j)
    for (int i = low(x, half); i <= high(x, half); ++i) {
      const int ci = std::clamp(i, 0, field.height.width() - 1);
      const int cj = std::clamp(j, 0, field.height.height() - 1);
      sum += static_cast<double>(field.height(ci, cj));
      ++count;
    }
  return static_cast<float>(sum / std::max(count, 1));
}

}  // namespace

HeightMap height_map(const Heightfield& field, int most_samples) {
  const int longest = std::max(field.height.width(), field.height.height());
  const double ratio = std::max(1.0, double{longest - 1.0} / (most_samples - 1));
  HeightMap map;
  map.width = std::max(2, static_cast<int>(std::lround((field.height.width() - 1) / ratio)) + 1);
  map.height = std::max(2, static_cast<int>(std::lround((field.height.height() - 1) / ratio)) + 1);
  map.cell = field.size().x / (map.width - 1);
  const double step_x = double{field.height.width() - 1.0} / (map.width - 1);
  const double step_y = double{field.height.height() - 1.0} / (map.height - 1);
  std::vector<float> heights;
  for (int j = 0; j < map.height; ++j)
    for (int i = 0; i < map.width; ++i)
      heights.push_back(mean_about(field, i * step_x, j * step_y, ratio));
  const auto [low, high] = std::minmax_element(heights.begin(), heights.end());
  map.heights = {*low, std::max(*high, *low + 1)};
  double bend = 0;
  for (const float h : heights) {
    const float share = (h - map.heights.low) / (map.heights.high - map.heights.low);
    map.samples.push_back(static_cast<std::uint16_t>(std::lround(65535 * share)));
  }
  for (int j = 0; j < map.height; ++j)
    for (int i = 1; i + 1 < map.width; ++i)
      bend += std::abs(double{map.at(i, j) - 0.5F * (map.at(i - 1, j) + map.at(i + 1, j))});
  map.roughness = static_cast<float>(
      bend / (static_cast<double>(map.height) * std::max(1, map.width - 2)) / map.cell);
  return map;
}

std::string packed(const HeightMap& map) {
  std::vector<unsigned char> raw;
  raw.reserve(2 * map.samples.size());
  const auto width = static_cast<std::size_t>(map.width);
  for (std::size_t k = 0; k < map.samples.size(); ++k) {
    std::uint16_t before = 0;
    if (k % width != 0)
      before = map.samples[k - 1];
    else if (k >= width)
      before = map.samples[k - width];
    const auto difference = static_cast<std::uint16_t>(map.samples[k] - before);
    raw.push_back(static_cast<unsigned char>(difference & 255U));
    raw.push_back(static_cast<unsigned char>(difference >> 8U));
  }
  uLongf length = compressBound(raw.size());
  std::vector<unsigned char> out(length);
  if (compress2(out.data(), &length, raw.data(), raw.size(), 9) != Z_OK)
    throw Error(ErrorKind::internal, "zlib failed to compress the height map");
  out.resize(length);
  return base64(out);
}

std::vector<std::uint16_t> unpacked(const std::string& text, int width, int height) {
  const std::vector<unsigned char> bytes = bytes_of(text);
  const auto count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  std::vector<unsigned char> raw(2 * count);
  uLongf length = raw.size();
  if (uncompress(raw.data(), &length, bytes.data(), bytes.size()) != Z_OK || length != raw.size())
    throw Error(ErrorKind::input, "no packed height map of that size");
  std::vector<std::uint16_t> samples(count);
  const auto row = static_cast<std::size_t>(width);
  for (std::size_t k = 0; k < count; ++k) {
    std::uint16_t before = 0;
    if (k % row != 0)
      before = samples[k - 1];
    else if (k >= row)
      before = samples[k - row];
    const auto difference = static_cast<unsigned>(raw[2 * k]) | raw[2 * k + 1] << 8U;
    samples[k] = static_cast<std::uint16_t>(before + difference);
  }
  return samples;
}

}  // namespace wold
