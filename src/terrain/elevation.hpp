#pragma once
// Heights from a file, as the file has them: a picture, raw integers, or real elevation data.
//
//   .exr .tif .tiff .png .jpg   pictures; floats are metres, integers fill a range
//   .r16 .raw                   16-bit integers without a header
//   .hgt, GeoTIFF, and what else GDAL opens with a place on Earth (.asc .bil .dem .dt2 .img .vrt)
//
// Elevation data tell their own metres. Where their samples are steps of longitude and latitude,
// the distance of samples is that on the WGS 84 ellipsoid at the middle of the data (radii of
// curvature of meridian and prime vertical); over a degree or two that is exact to a part in a
// hundred. Samples without data are filled from those around them.

#include <optional>
#include <string>

#include "base/parameters.hpp"
#include "base/progress.hpp"
#include "image/io.hpp"
#include "terrain/heightfield.hpp"

namespace wold {

enum class PictureValues {
  automatic,  ///< metres if the file has floats, else the range in the file, or else `height`
  range,      ///< 0 and 1 (black and white) are the ends of `height`
  metres
};

/// How to read files that do not tell themselves.
struct ElevationOptions {
  std::string channel = {};  ///< empty: the first
  Range height{0, 1000};     ///< m, of black and white
  PictureValues values = PictureValues::automatic;
  Transfer transfer = Transfer::as_stored;
  ByteOrder byte_order = ByteOrder::little;  ///< of RAW16
  bool flip = false;                         ///< of RAW16: rows begin in the south
  int raw_width = 0;                         ///< pixels of RAW16; 0: a square
};

struct Elevation {
  Grid<float> height;          ///< m
  DVec2 spacing{0};            ///< m between samples, east and north; 0 where the file is silent
  bool knows_heights = false;  ///< the file itself tells metres
  std::optional<Range> range;  ///< m, of black and white, where the file holds integers
  bool georeferenced = false;  ///< it has a place on Earth
  std::size_t filled = 0;      ///< samples without data that were filled
  std::string format;          ///< "picture", "raw integers", "SRTMHGT", "GTiff", …
};

/// Throws Error(io) for a missing or unreadable file, Error(input) for what is no height map, an
/// unknown channel, or data that lie askew, Error(limit) for what would not fit in memory, and
/// Error(usage) for elevation data where wold was built without GDAL.
Elevation read_elevation(const std::string& path, const ElevationOptions& options = {});

/// The heights on square cells around (0, 0): as they are, or, where the spacings east and north
/// differ, resampled to the narrower one. `elevation.spacing` must be known.
Heightfield square_field(const Elevation& elevation, Progress& progress);

/// The names under which an exported picture records the heights of 0 and 1 and the distance of
/// samples, m.
inline constexpr const char* low_height_key = "wold_low_height";
inline constexpr const char* high_height_key = "wold_high_height";
inline constexpr const char* cell_key = "wold_cell";

}  // namespace wold
