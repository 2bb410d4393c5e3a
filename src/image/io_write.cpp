#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstddef>
#include <cstdio>

#include "base/error.hpp"
#include "base/hash.hpp"
#include "image/atomic_file.hpp"
#include "image/io.hpp"

namespace wold {

namespace {

namespace oiio = OIIO;

std::string first_line(const std::string& text) {
  return text.substr(0, text.find('\n'));
}

Error cannot_write(const std::string& path, const std::string& why) {
  return {ErrorKind::io, fmt::format("cannot write '{}': {}", path, first_line(why))};
}

oiio::ImageSpec spec_of(const Image& image, const oiio::TypeDesc& type, const Metadata& metadata) {
  oiio::ImageSpec spec(image.width, image.height, image.channel_count(), type);
  spec.channelnames = image.channels;
  spec.alpha_channel = -1;
  spec.z_channel = -1;
  for (const auto& [name, text] : metadata) spec.attribute(name, text);
  // Else the library puts the time of writing there.
  if (metadata.find("DateTime") == metadata.end()) spec.attribute("DateTime", "");
  return spec;
}

/// A file that remembers the first write that failed: not every writer of the library tells.
class CheckedFile : public oiio::Filesystem::IOFile {
 public:
  explicit CheckedFile(const std::string& path) : IOFile(path, Write) {}

  std::size_t write(const void* bytes, std::size_t size) override {
    return checked(IOFile::write(bytes, size), size);
  }
  std::size_t pwrite(const void* bytes, std::size_t size, std::int64_t offset) override {
    return checked(IOFile::pwrite(bytes, size, offset), size);
  }
  /// The error number of the first failure, after handing everything to the system; 0 for none.
  int finish() {
    if (m_file != nullptr && std::fflush(m_file) != 0 && error_ == 0) error_ = errno;
    return error_;
  }

 private:
  std::size_t checked(std::size_t written, std::size_t size) {
    if (written < size && error_ == 0) error_ = errno != 0 ? errno : EIO;
    return written;
  }
  int error_ = 0;
};

void write_with(const std::string& path, const oiio::ImageSpec& spec, oiio::TypeDesc type,
                const void* pixels) {
  write_atomically(path, [&](const std::string& temporary) {
    CheckedFile file(temporary);
    const auto output = oiio::ImageOutput::create(temporary, &file);
    if (!output) throw cannot_write(path, oiio::geterror());
    const bool written = output->open(temporary, spec) && output->write_image(type, pixels);
    const bool closed = output->close();
    if (const int error = file.finish(); error != 0) throw cannot_write(path, io_reason(error));
    // A text alone is no failure: TIFF leaves one about Exif data that it has not.
    if (!written || !closed) throw cannot_write(path, output->geterror());
  });
}

float within_half(float value) {
  constexpr float largest = 65504;
  return std::isfinite(value) ? std::clamp(value, -largest, largest) : value;
}

/// The pixels as the file stores them: each channel with its own type, packed.
std::vector<std::byte> packed(const Image& image, const std::vector<oiio::TypeDesc>& types) {
  std::size_t pixel_size = 0;
  for (const oiio::TypeDesc& type : types) pixel_size += type.size();
  const std::size_t channels = types.size();
  const std::size_t count = image.pixels.size() / channels;
  std::vector<std::byte> bytes(count * pixel_size);
  std::byte* out = bytes.data();
  for (std::size_t k = 0; k < count; ++k)
    for (std::size_t c = 0; c < channels; ++c) {
      const bool half = types[c] == oiio::TypeHalf;
      const float raw = image.pixels[k * channels + c];
      const float value = half ? within_half(raw) : raw;
      oiio::convert_pixel_values(oiio::TypeFloat, &value, types[c], out, 1);
      out += types[c].size();
    }
  return bytes;
}

/// Rounds down after adding the same noise in [0, 1) to all channels of a pixel: right on average,
/// whole values stay, grey stays grey.
std::uint8_t dithered(float value, float noise) {
  const float v = std::isnan(value) ? 0.0F : std::clamp(value, 0.0F, 1.0F);
  return static_cast<std::uint8_t>(std::min(255.0F, std::floor(v * 255.0F + noise)));
}

std::vector<std::uint8_t> eight_bits(const Image& image, bool dither) {
  std::vector<std::uint8_t> values(image.pixels.size());
  const std::size_t channels = image.channels.size();
  for (std::size_t k = 0; k < values.size(); ++k) {
    const float noise = dither ? uniform(random_bits(0x646974686572U, k / channels)) : 0.5F;
    values[k] = dithered(image.pixels[k], noise);
  }
  return values;
}

std::vector<std::uint16_t> sixteen_bits(const Image& image) {
  std::vector<std::uint16_t> values(image.pixels.size());
  std::transform(image.pixels.begin(), image.pixels.end(), values.begin(),
                 [](float v) { return static_cast<std::uint16_t>(quantised(v, 65535)); });
  return values;
}

}  // namespace

std::uint32_t quantised(float value, std::uint32_t largest) {
  if (!(value > 0)) return 0;
  const double scaled = std::min(1.0, static_cast<double>(value)) * largest;
  return static_cast<std::uint32_t>(std::lround(scaled));
}

void write_exr(const std::string& path, const Image& image, const ExrOptions& options) {
  oiio::ImageSpec spec = spec_of(image, oiio::TypeFloat, options.metadata);
  spec.attribute("compression", "zip");
  const auto& half = options.half_channels;
  for (const std::string& name : image.channels) {
    const bool is_half = std::find(half.begin(), half.end(), name) != half.end();
    spec.channelformats.push_back(is_half ? oiio::TypeHalf : oiio::TypeFloat);
  }
  if (half.empty()) {
    spec.channelformats.clear();
    return write_with(path, spec, oiio::TypeFloat, image.pixels.data());
  }
  write_with(path, spec, oiio::TypeUnknown, packed(image, spec.channelformats).data());
}

void write_png(const std::string& path, const Image& image, const PngOptions& options) {
  if (options.bits != 8 && options.bits != 16)
    throw Error(ErrorKind::usage,
                fmt::format("cannot write '{}': PNG has 8 or 16 bits, not {}", path, options.bits));
  if (image.channel_count() < 1 || image.channel_count() > 4)
    throw Error(ErrorKind::input,
                fmt::format("cannot write '{}': PNG holds 1 to 4 channels, the picture has {}; "
                            "write EXR or TIFF",
                            path, image.channel_count()));
  const bool eight = options.bits == 8;
  oiio::ImageSpec spec =
      spec_of(image, eight ? oiio::TypeUInt8 : oiio::TypeUInt16, options.metadata);
  spec.erase_attribute("DateTime");
  if (image.channel_count() % 2 == 0) spec.alpha_channel = image.channel_count() - 1;
  spec.attribute("oiio:UnassociatedAlpha", 1);  // colours as they are, not divided by alpha
  if (options.srgb) spec.attribute("oiio:ColorSpace", "sRGB");
  if (eight)
    write_with(path, spec, oiio::TypeUInt8, eight_bits(image, options.dither).data());
  else
    write_with(path, spec, oiio::TypeUInt16, sixteen_bits(image).data());
}

void write_tiff(const std::string& path, const Image& image, const Metadata& metadata) {
  // A TIFF has no place for names of one's own: they go into its description, a line each.
  std::string description;
  for (const auto& [name, text] : metadata) description += fmt::format("{}={}\n", name, text);
  oiio::ImageSpec spec = spec_of(image, oiio::TypeFloat, {});
  if (!description.empty()) spec.attribute("ImageDescription", description);
  spec.attribute("compression", "zip");
  spec.attribute("oiio:UnassociatedAlpha", 1);
  write_with(path, spec, oiio::TypeFloat, image.pixels.data());
}

void write_raw16(const std::string& path, const Image& image, const Raw16Options& options) {
  if (image.channel_count() != 1)
    throw Error(ErrorKind::input,
                fmt::format("cannot write '{}': a raw height map holds 1 channel, the picture has "
                            "{}",
                            path, image.channel_count()));
  std::string bytes;
  bytes.reserve(image.pixels.size() * 2);
  for (int y = 0; y < image.height; ++y)
    for (const float v : image.row(options.flip ? image.height - 1 - y : y)) {
      const std::uint32_t value = quantised(v, 65535);
      const auto low = static_cast<char>(value & 255U);
      const auto high = static_cast<char>(value >> 8U);
      const bool little = options.order == ByteOrder::little;
      bytes.push_back(little ? low : high);
      bytes.push_back(little ? high : low);
    }
  write_file(path, bytes);
}

void write_picture(const std::string& path, const Image& image, const Metadata& metadata) {
  check_picture_writable(path);
  const std::string extension = extension_of(path);
  if (extension == ".exr") return write_exr(path, image, {.metadata = metadata});
  if (extension == ".png") return write_png(path, image, {.metadata = metadata});
  if (extension == ".r16" || extension == ".raw") return write_raw16(path, image);
  write_tiff(path, image, metadata);
}

const std::vector<std::string>& picture_extensions() {
  static const std::vector<std::string> extensions{".exr", ".png", ".tif", ".tiff", ".r16", ".raw"};
  return extensions;
}

void check_picture_writable(const std::string& path) {
  check_writable(path, picture_extensions());
}

}  // namespace wold
