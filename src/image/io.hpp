#pragma once
// Pictures from and to files (OpenImageIO): EXR, PNG, TIFF, JPEG and whatever else the library
// reads, and raw 16-bit height maps as engines take them. Files are written whole or not at all
// (atomic_file.hpp), and the same picture gives the same bytes: no times, no host names.

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "image/image.hpp"

namespace wold {

/// What to do with the sRGB curve when reading 8- and 16-bit pictures. Floats are never changed,
/// nor is alpha.
enum class Transfer {
  as_stored,  ///< values as they are: heights, masks
  if_tagged,  ///< linear light where the file says that it is sRGB, else as stored
  srgb        ///< linear light: the file is sRGB whatever it says
};

struct Picture {
  Image image;                                  ///< integers scaled to [0, 1]
  int bits = 8;                                 ///< of a channel in the file: 8, 16 or 32
  bool floating = false;                        ///< the file stores floats
  bool srgb_tagged = false;                     ///< the file itself says that it is sRGB
  std::map<std::string, std::string> metadata;  ///< texts
};

/// Reads all channels of a picture. Throws Error(io) if the file is missing or unreadable,
/// Error(input) if it is no picture or a damaged one, Error(limit) if it would not fit in memory.
Picture read_picture(const std::string& path, Transfer transfer = Transfer::as_stored);

using Metadata = std::map<std::string, std::string>;

struct ExrOptions {
  std::vector<std::string> half_channels = {};  ///< 16-bit floats; the others have 32 bits
  Metadata metadata = {};
};
/// All channels, ZIP compressed. Finite values beyond the range of a half are held at its ends.
void write_exr(const std::string& path, const Image& image, const ExrOptions& options = {});

struct PngOptions {
  int bits = 16;        ///< 8 or 16
  bool srgb = false;    ///< tag as sRGB: `image` holds display-encoded values
  bool dither = false;  ///< 8 bits only: hide the steps in smooth skies; the same noise each time
  Metadata metadata = {};
};
/// Values in [0, 1], others are held at the ends; NaN becomes 0. 1 to 4 channels (grey, grey and
/// alpha, RGB, RGBA). Throws Error(input) for another number of channels.
void write_png(const std::string& path, const Image& image, const PngOptions& options = {});

/// 32-bit floats, all channels, ZIP compressed.
void write_tiff(const std::string& path, const Image& image, const Metadata& metadata = {});

enum class ByteOrder { little, big };

struct Raw16Options {
  ByteOrder order = ByteOrder::little;
  bool flip = false;  ///< the first row in the file is the bottom of the picture
};
/// Values in [0, 1] of one channel as unsigned 16-bit integers, row by row, without a header.
void write_raw16(const std::string& path, const Image& image, const Raw16Options& options = {});

/// Reads what `write_raw16` wrote. A width and height of 0 mean a square. Throws Error(input) if
/// the file has not the size of such a picture.
Image read_raw16(const std::string& path, int width = 0, int height = 0,
                 const Raw16Options& options = {});

/// Writes by extension: .exr (floats), .png (16 bits, not tagged), .tif, .tiff, .r16, .raw.
void write_picture(const std::string& path, const Image& image, const Metadata& metadata = {});

/// The extensions that `write_picture` knows.
const std::vector<std::string>& picture_extensions();

/// To be called before long work: throws unless `path` could be written as a picture.
void check_picture_writable(const std::string& path);

/// Rounds a value in [0, 1] to an integer in [0, largest]; NaN becomes 0.
std::uint32_t quantised(float value, std::uint32_t largest);

}  // namespace wold
