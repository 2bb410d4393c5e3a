#include "realtime/packing.hpp"

#include <zlib.h>

#include <array>
#include <cstddef>
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

/// Of the sample before, 0 at the very first.
template <class Sample>
Sample before(const std::vector<Sample>& samples, std::size_t k, std::size_t width) {
  if (k % width != 0) return samples[k - 1];
  return k >= width ? samples[k - width] : Sample{0};
}

template <class Sample>
std::string pack(const std::vector<Sample>& samples, int width) {
  std::vector<unsigned char> raw;
  raw.reserve(sizeof(Sample) * samples.size());
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const auto difference =
        static_cast<Sample>(samples[k] - before(samples, k, static_cast<std::size_t>(width)));
    for (std::size_t b = 0; b < sizeof(Sample); ++b)
      raw.push_back(static_cast<unsigned char>(difference >> 8 * b & 255));
  }
  uLongf length = compressBound(raw.size());
  std::vector<unsigned char> out(length);
  if (compress2(out.data(), &length, raw.data(), raw.size(), 9) != Z_OK)
    throw Error(ErrorKind::internal, "zlib failed to compress a map");
  out.resize(length);
  return base64(out);
}

template <class Sample>
std::vector<Sample> unpack(const std::string& text, int width, int height) {
  const std::vector<unsigned char> bytes = bytes_of(text);
  const auto row = static_cast<std::size_t>(width);
  std::vector<Sample> samples(row * static_cast<std::size_t>(height));
  std::vector<unsigned char> raw(sizeof(Sample) * samples.size());
  uLongf length = raw.size();
  if (uncompress(raw.data(), &length, bytes.data(), bytes.size()) != Z_OK || length != raw.size())
    throw Error(ErrorKind::input, "no packed map of that size");
  for (std::size_t k = 0; k < samples.size(); ++k) {
    unsigned difference = 0;
    for (std::size_t b = 0; b < sizeof(Sample); ++b)
      difference |= static_cast<unsigned>(raw[sizeof(Sample) * k + b]) << 8 * b;
    samples[k] = static_cast<Sample>(before(samples, k, row) + difference);
  }
  return samples;
}

}  // namespace

std::string packed(const std::vector<std::uint16_t>& samples, int width) {
  return pack(samples, width);
}
std::string packed(const std::vector<std::uint8_t>& samples, int width) {
  return pack(samples, width);
}

std::vector<std::uint16_t> unpacked_words(const std::string& text, int width, int height) {
  return unpack<std::uint16_t>(text, width, height);
}
std::vector<std::uint8_t> unpacked_bytes(const std::string& text, int width, int height) {
  return unpack<std::uint8_t>(text, width, height);
}

}  // namespace wold
