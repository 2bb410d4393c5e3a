#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/error.hpp"
#include "image/atomic_file.hpp"
#include "image/color.hpp"
#include "image/io.hpp"

namespace wold {

namespace {

namespace oiio = OIIO;

void check_readable(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file || file.peek() == std::ifstream::traits_type::eof()) {
    const std::string bytes = read_file(path);  // says what is wrong with the file, if anything
    if (bytes.empty())
      throw Error(ErrorKind::input, fmt::format("'{}' is not a picture: the file is empty", path));
  }
}

std::string first_line(const std::string& text) {
  return text.substr(0, text.find('\n'));
}

/// What the chunks of a PNG tell. OpenImageIO calls every PNG sRGB, and libpng prints when one is
/// cut short.
struct PngChunks {
  bool srgb = false;
  bool complete = false;
};

PngChunks png_chunks(const std::string& path) {
  PngChunks found;
  std::ifstream file(path, std::ios::binary);
  file.seekg(8);
  std::array<unsigned char, 8> head{};
  while (file.read(reinterpret_cast<char*>(head.data()), 8)) {
    const std::uint32_t length = (std::uint32_t{head[0]} << 24U) | (std::uint32_t{head[1]} << 16U) |
                                 (std::uint32_t{head[2]} << 8U) | std::uint32_t{head[3]};
    const std::string type(reinterpret_cast<const char*>(&head[4]), 4);
    if (type == "sRGB") found.srgb = true;
    if (type == "IEND") found.complete = true;
    file.seekg(std::streamoff{length} + 4, std::ios::cur);
  }
  return found;
}

Error damaged(const std::string& path, const std::string& why) {
  return {ErrorKind::input,
          fmt::format("'{}' is damaged or cut short ({})", path, first_line(why))};
}

/// A few bytes may announce a picture that fills the memory. Deflate packs up to 1032 bytes into
/// one, and a pixel of one bit may become three channels of a byte.
void check_png_size(const std::string& path, const oiio::ImageSpec& spec) {
  constexpr double most = 1032 * 24;
  std::error_code error;
  const auto size = static_cast<double>(std::filesystem::file_size(path, error));
  if (!error && static_cast<double>(spec.image_bytes(true)) > most * size)
    throw damaged(path, fmt::format("{} x {} pixels cannot be in {:.0f} bytes", spec.width,
                                    spec.height, size));
}

bool is_tagged_srgb(const oiio::ImageSpec& spec) {
  const std::string profile{spec.get_string_attribute("ICCProfile:profile_description")};
  return profile.find("sRGB") != std::string::npos ||
         spec.get_int_attribute("Exif:ColorSpace") == 1;
}

std::unique_ptr<oiio::ImageInput> open_picture(const std::string& path) {
  check_readable(path);
  oiio::ImageSpec config;
  config.attribute("oiio:UnassociatedAlpha", 1);  // colours as stored, not multiplied by alpha
  auto input = oiio::ImageInput::open(path, &config);
  if (!input)
    throw Error(ErrorKind::input,
                fmt::format("'{}' is not a picture that can be read ({}); EXR, PNG, TIFF and JPEG "
                            "can",
                            path, first_line(oiio::geterror())));
  return input;
}

/// The lines "name=text" of a description, as `write_tiff` leaves them.
void add_described(const std::string& description, std::map<std::string, std::string>& texts) {
  std::istringstream lines(description);
  for (std::string line; std::getline(lines, line);)
    if (const std::size_t sign = line.find('='); sign != std::string::npos)
      texts.emplace(line.substr(0, sign), line.substr(sign + 1));
}

std::map<std::string, std::string> texts_of(const oiio::ImageSpec& spec) {
  std::map<std::string, std::string> texts;
  add_described(std::string(spec.get_string_attribute("ImageDescription")), texts);
  for (const auto& attribute : spec.extra_attribs)
    if (attribute.type() == oiio::TypeString)
      texts.emplace(attribute.name().string(), attribute.get_string());
  return texts;
}

void linearise(Image& image) {
  std::vector<bool> is_alpha;
  for (const std::string& name : image.channels) is_alpha.push_back(name == "A");
  const std::size_t channels = image.channels.size();
  for (std::size_t k = 0; k < image.pixels.size(); ++k)
    if (!is_alpha[k % channels]) image.pixels[k] = srgb_to_linear(image.pixels[k]);
}

}  // namespace

Picture read_picture(const std::string& path, Transfer transfer) {
  const auto input = open_picture(path);
  const oiio::ImageSpec& spec = input->spec();
  Picture picture;
  picture.floating = spec.format.is_floating_point();
  picture.bits =
      spec.get_int_attribute("oiio:BitsPerSample", static_cast<int>(spec.format.basesize()) * 8);
  picture.srgb_tagged = is_tagged_srgb(spec);
  if (std::string(input->format_name()) == "png") {
    const PngChunks chunks = png_chunks(path);
    if (!chunks.complete) throw damaged(path, "it has no end");
    check_png_size(path, spec);
    picture.srgb_tagged = picture.srgb_tagged || chunks.srgb;
  }
  picture.metadata = texts_of(spec);
  try {
    picture.image = Image(spec.width, spec.height, spec.channelnames);
  } catch (const Error& e) {
    throw Error(e.kind(), fmt::format("cannot read '{}': {}", path, e.message()));
  }
  const bool read =
      input->read_image(0, 0, 0, spec.nchannels, oiio::TypeFloat, picture.image.pixels.data());
  const std::string why = input->geterror();  // TIFF says it only here
  if (!read || !why.empty()) throw damaged(path, why);
  const bool linear = transfer == Transfer::as_stored || picture.floating ||
                      (transfer == Transfer::if_tagged && !picture.srgb_tagged);
  if (!linear) linearise(picture.image);
  return picture;
}

Image read_raw16(const std::string& path, int width, int height, const Raw16Options& options) {
  const std::string bytes = read_file(path);
  const std::size_t samples = bytes.size() / 2;
  if (width == 0 && height == 0)
    width = height = static_cast<int>(std::lround(std::sqrt(static_cast<double>(samples))));
  const auto expected = static_cast<double>(width) * height * 2;
  if (width < 1 || height < 1 || static_cast<double>(bytes.size()) != expected)
    throw Error(ErrorKind::input,
                fmt::format("'{}' has {} bytes, but a 16-bit raw picture of {} x {} has {:.0f}; "
                            "give its width and height",
                            path, bytes.size(), width, height, expected));
  Image image(width, height, {"Y"});
  const std::size_t low = options.order == ByteOrder::little ? 0 : 1;
  for (int y = 0; y < height; ++y) {
    const int row = options.flip ? height - 1 - y : y;
    for (int x = 0; x < width; ++x) {
      const std::size_t k = 2 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                                 static_cast<std::size_t>(x));
      const auto value = static_cast<unsigned char>(bytes[k + low]) +
                         256 * static_cast<unsigned char>(bytes[k + 1 - low]);
      image.at(x, y, 0) = static_cast<float>(value) / 65535.0F;
    }
  }
  return image;
}

}  // namespace wold
