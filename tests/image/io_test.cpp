#include "image/io.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cmath>
#include <csignal>
#include <filesystem>
#include <limits>

#include "../base/testing.hpp"
#include "base/hash.hpp"
#include "image/atomic_file.hpp"
#include "image/color.hpp"

namespace wold {
namespace {

using testing_base::error_of;
using testing_base::expect_contains;

class ImageIo : public testing_base::FolderTest {};

Image noise_picture(int width, int height, std::vector<std::string> channels) {
  Image image(width, height, std::move(channels));
  for (std::size_t k = 0; k < image.pixels.size(); ++k)
    image.pixels[k] = uniform(random_bits(7, k));
  return image;
}

float largest_difference(const Image& a, const Image& b) {
  EXPECT_EQ(a.pixels.size(), b.pixels.size());
  float largest = 0;
  for (std::size_t k = 0; k < std::min(a.pixels.size(), b.pixels.size()); ++k)
    largest = std::max(largest, std::abs(a.pixels[k] - b.pixels[k]));
  return largest;
}

TEST_F(ImageIo, ExrKeepsFloatsNamesAndMetadata) {
  Image image = noise_picture(33, 17, {"R", "G", "B", "A", "albedo.R", "N.X", "N.Y", "N.Z", "Z"});
  image.at(3, 4, 8) = std::numeric_limits<float>::infinity();
  image.at(0, 0, 5) = -1e30F;
  write_exr(path("a.exr"), image, {.metadata = {{"wold:seed", "42"}, {"note", "two words"}}});
  const Picture read = read_picture(path("a.exr"));
  EXPECT_TRUE(read.floating);
  EXPECT_EQ(read.bits, 32);
  EXPECT_EQ(read.metadata.at("wold:seed"), "42");
  EXPECT_EQ(read.metadata.at("note"), "two words");
  for (const std::string& name : image.channels)
    EXPECT_EQ(channel_grid(read.image, name), channel_grid(image, name)) << name;
}

TEST_F(ImageIo, ExrChannelsMayBeHalf) {
  Image image = noise_picture(20, 10, {"R", "G", "B", "Z"});
  image.at(1, 1, 0) = 1e6F;
  write_exr(path("a.exr"), image, {.half_channels = {"R", "G", "B"}});
  const Image read = read_picture(path("a.exr")).image;
  EXPECT_EQ(channel_grid(read, "Z"), channel_grid(image, "Z"));
  EXPECT_EQ(read.at(1, 1, 0), 65504.0F);
  image.at(1, 1, 0) = 65504.0F;
  EXPECT_GT(largest_difference(read, image), 0.0F);
  EXPECT_LE(largest_difference(read, image), 0x1p-11F);
}

TEST_F(ImageIo, SamePictureSameBytes) {
  const Image image = noise_picture(64, 64, {"R", "G", "B", "Z"});
  const std::vector<std::string> names{"a.exr", "a.tif", "a.png"};
  std::vector<std::string> first;
  for (const std::string& name : names) {
    write_picture(path(name), image, {{"note", "x"}});
    first.push_back(read_file(path(name)));
  }
  ::sleep(1);  // a time in the file would differ now
  for (std::size_t k = 0; k < names.size(); ++k) {
    write_picture(path(names[k]), image, {{"note", "x"}});
    EXPECT_TRUE(first[k] == read_file(path(names[k]))) << names[k];
  }
}

TEST_F(ImageIo, PngKeepsItsPrecision) {
  for (const int bits : {8, 16})
    for (const int channels : {1, 2, 3, 4}) {
      const std::vector<std::string> names =
          channels < 3 ? layer_channels("", std::string("YA").substr(0, channels))
                       : layer_channels("", std::string("RGBA").substr(0, channels));
      const Image image = noise_picture(19, 23, names);
      write_png(path("a.png"), image, {.bits = bits});
      const Picture read = read_picture(path("a.png"), Transfer::if_tagged);
      EXPECT_EQ(read.bits, bits);
      EXPECT_EQ(read.image.channel_count(), channels);
      EXPECT_FALSE(read.srgb_tagged);
      const float step = bits == 8 ? 1.0F / 255 : 1.0F / 65535;
      EXPECT_LE(largest_difference(read.image, image), 0.5001F * step + 1e-7F);
    }
}

TEST_F(ImageIo, PngHoldsValuesAtItsEnds) {
  Image image(4, 1, {"Y"});
  image.pixels = {-3.0F, 7.0F, std::nanf(""), std::numeric_limits<float>::infinity()};
  for (const int bits : {8, 16}) {
    write_png(path("a.png"), image, {.bits = bits, .dither = true});
    EXPECT_EQ(read_picture(path("a.png")).image.pixels, (std::vector<float>{0, 1, 0, 1}));
  }
}

TEST_F(ImageIo, DitherIsRightOnAverageAndKeepsGrey) {
  const Image image(64, 64, {"R", "G", "B"}, 100.25F / 255);
  write_png(path("a.png"), image, {.bits = 8, .dither = true});
  const Image read = read_picture(path("a.png")).image;
  double sum = 0;
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) {
      EXPECT_EQ(read.at(x, y, 0), read.at(x, y, 2));
      sum += static_cast<double>(read.at(x, y, 1)) * 255;
    }
  EXPECT_NEAR(sum / 4096, 100.25, 4 * std::sqrt(0.25 * 0.75 / 4096));
  const Image whole(8, 8, {"Y"}, 100.0F / 255);
  write_png(path("b.png"), whole, {.bits = 8, .dither = true});
  EXPECT_LE(largest_difference(read_picture(path("b.png")).image, whole), 1e-6F);
}

TEST_F(ImageIo, SrgbIsLinearisedOnlyWhenAskedOrTagged) {
  Image image(2, 1, {"R", "G", "B", "A"}, 0.5F);
  image.pixels[0] = 0.03F;
  write_png(path("plain.png"), image);
  write_png(path("tagged.png"), image, {.srgb = true});
  const auto value = [&](const std::string& name, Transfer transfer, int c) {
    return read_picture(path(name), transfer).image.at(1, 0, c);
  };
  EXPECT_TRUE(read_picture(path("tagged.png")).srgb_tagged);
  EXPECT_NEAR(value("plain.png", Transfer::as_stored, 1), 0.5F, 1e-5F);
  EXPECT_NEAR(value("plain.png", Transfer::if_tagged, 1), 0.5F, 1e-5F);
  EXPECT_NEAR(value("plain.png", Transfer::srgb, 1), 0.214041F, 1e-5F);
  EXPECT_NEAR(value("tagged.png", Transfer::as_stored, 1), 0.5F, 1e-5F);
  EXPECT_NEAR(value("tagged.png", Transfer::if_tagged, 1), 0.214041F, 1e-5F);
  EXPECT_NEAR(value("tagged.png", Transfer::if_tagged, 3), 0.5F, 1e-5F);
  EXPECT_NEAR(read_picture(path("tagged.png"), Transfer::srgb).image.pixels[0], 0.03F / 12.92F,
              1e-5F);
}

TEST_F(ImageIo, TiffKeepsFloats) {
  const Image image = noise_picture(31, 9, {"Y"});
  write_tiff(path("a.tif"), image);
  const Picture read = read_picture(path("a.tif"), Transfer::srgb);
  EXPECT_TRUE(read.floating);
  EXPECT_EQ(read.image.pixels, image.pixels);
  const Image colors = noise_picture(31, 9, {"R", "G", "B", "A"});
  write_picture(path("b.tiff"), colors);
  EXPECT_EQ(read_picture(path("b.tiff")).image.pixels, colors.pixels);
}

TEST_F(ImageIo, RawHasBothByteOrdersAndFlips) {
  Image image(2, 2, {"Y"});
  image.pixels = {0x1234 / 65535.0F, 0.0F, 1.0F, 0xabcd / 65535.0F};
  write_raw16(path("a.r16"), image);
  EXPECT_EQ(read_file(path("a.r16")), std::string("\x34\x12\0\0\xff\xff\xcd\xab", 8));
  write_raw16(path("b.raw"), image, {.order = ByteOrder::big, .flip = true});
  EXPECT_EQ(read_file(path("b.raw")), std::string("\xff\xff\xab\xcd\x12\x34\0\0", 8));
  EXPECT_EQ(read_raw16(path("a.r16")).pixels, image.pixels);
  const Image read = read_raw16(path("b.raw"), 2, 2, {.order = ByteOrder::big, .flip = true});
  EXPECT_EQ(read.pixels, image.pixels);
  const std::string message = error_of([&] { read_raw16(path("a.r16"), 3, 2); }, ErrorKind::input);
  expect_contains(message, "a.r16' has 8 bytes, but a 16-bit raw picture of 3 x 2 has 12");
}

TEST_F(ImageIo, GridsAreTurnedOver) {
  Grid<float> heights(3, 2);
  heights(0, 0) = 0.25F;  // south-west
  write_picture(path("a.exr"), image_of(heights));
  const Image read = read_picture(path("a.exr")).image;
  EXPECT_EQ(read.at(0, 1, 0), 0.25F);
  EXPECT_EQ(channel_grid(read), heights);
  Grid<Vec3> colors(3, 2, Vec3(1, 2, 3));
  colors(2, 1) = Vec3(4, 5, 6);
  EXPECT_EQ(image_of(colors).at(2, 0, 1), 5.0F);
  EXPECT_EQ(color_grid(image_of(colors)), colors);
}

TEST_F(ImageIo, ReadErrorsNameTheFileAndWhatWouldBeRight) {
  expect_contains(error_of([&] { read_picture(path("no.png")); }, ErrorKind::io),
                  "no.png': there is no such file");
  expect_contains(error_of([&] { read_picture(folder().string()); }, ErrorKind::io), "is a folder");
  write_file(path("text.png"), "These are words, not a picture.");
  const std::string message = error_of([&] { read_picture(path("text.png")); }, ErrorKind::input);
  expect_contains(message, "text.png' is not a picture");
  expect_contains(message, "EXR, PNG, TIFF and JPEG can");
  EXPECT_EQ(message.find('\n'), std::string::npos);
  write_file(path("empty.exr"), "");
  expect_contains(error_of([&] { read_picture(path("empty.exr")); }, ErrorKind::input),
                  "the file is empty");
}

TEST_F(ImageIo, CutShortPicturesAreRefused) {
  const Image image = noise_picture(64, 64, {"R", "G", "B"});
  for (const std::string name : {"a.exr", "a.png", "a.tif"}) {
    write_picture(path(name), image);
    const std::string bytes = read_file(path(name));
    write_file(path(name), std::string_view(bytes).substr(0, bytes.size() / 2));
    const std::string message = error_of([&] { read_picture(path(name)); }, ErrorKind::input);
    expect_contains(message, name);
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

TEST_F(ImageIo, WriteErrorsNameTheFileAndWhatWouldBeRight) {
  const Image image(2, 2, {"R", "G", "B", "A", "Z"});
  expect_contains(error_of([&] { write_png(path("a.png"), image); }, ErrorKind::input),
                  "PNG holds 1 to 4 channels, the picture has 5; write EXR or TIFF");
  expect_contains(error_of([&] { write_picture(path("a.bmq"), image); }, ErrorKind::usage),
                  "unknown extension '.bmq'; known are .exr, .png, .tif, .tiff, .r16, .raw");
  expect_contains(error_of([&] { write_picture(path("no/a.exr"), image); }, ErrorKind::io),
                  "/no' does not exist");
  expect_contains(error_of([&] { write_raw16(path("a.r16"), image); }, ErrorKind::input),
                  "holds 1 channel, the picture has 5");
  EXPECT_EQ(file_count(), 0);
}

/// Files can grow to `bytes` only while this lives: what a full disk looks like to a program.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit before_{};
  void (*handler_)(int);
};

TEST_F(ImageIo, FullDiskLeavesTheOldPictureAndNothingElse) {
  const Image old_picture = noise_picture(4, 4, {"Y"});
  const Image image = noise_picture(256, 256, {"Y"});
  for (const std::string name : {"a.exr", "a.png", "a.tif", "a.r16"}) {
    write_picture(path(name), old_picture);
    const std::string before = read_file(path(name));
    std::string message;
    {
      const FileSizeLimit limit(20000);
      message = error_of([&] { write_picture(path(name), image); }, ErrorKind::io);
    }
    expect_contains(message, "cannot write '" + path(name) + "'");
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    EXPECT_TRUE(read_file(path(name)) == before) << name;
  }
  EXPECT_EQ(file_count(), 4);
}

TEST(ImageTest, HugeIsRefusedBeforeTheWork) {
  const std::string message =
      error_of([] { const Image image(2000000, 2000000, {"R"}); }, ErrorKind::limit);
  expect_contains(message, "2000000 x 2000000 with 1 channels");
  expect_contains(error_of([] { const Image image(0, 3, {"R"}); }, ErrorKind::input), "at least");
}

TEST(ImageTest, UnknownChannelListsTheKnown) {
  const Image image(1, 1, {"R", "N.X"});
  expect_contains(error_of([&] { channel_grid(image, "Z"); }, ErrorKind::input),
                  "no channel 'Z'; it has: R, N.X");
}

TEST(Color, SrgbCurveIsItsOwnInverse) {
  for (float c = -1; c <= 2; c += 0.01F)
    EXPECT_NEAR(linear_to_srgb(srgb_to_linear(c)), c, 2e-6F) << c;
  EXPECT_NEAR(srgb_to_linear(0.04045F), 0.0031308F, 1e-7F);
  EXPECT_NEAR(srgb_to_linear(1.0F), 1.0F, 1e-6F);
}

}  // namespace
}  // namespace wold
