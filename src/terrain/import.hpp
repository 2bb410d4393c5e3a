#pragma once
// Ground from a picture: a height map made elsewhere.
//
// The picture lies over the terrain with north up; its outermost pixels' centres lie on the
// terrain's border, so a map of 2^n + 1 pixels fits samples exactly. Between pixels it is bicubic;
// where the terrain is coarser, the picture is smoothed to its spacing first. Beyond its border the
// nearest height goes on.
//
// Heights of pictures with integers (PNG, most TIFF, RAW16) fill a range of metres: the one that
// wold recorded in the file, or the parameter `height`. Those of pictures with floats (EXR, float
// TIFF) are metres already. Pixels without a number (NaN, infinity) get the lowest height.

#include "image/io.hpp"
#include "terrain/operator.hpp"

namespace wold {

enum class PictureValues {
  automatic,  ///< metres if the file has floats, else the range in the file, or else `height`
  range,      ///< 0 and 1 (black and white) are the ends of `height`
  metres
};

struct Import {
  FilePath file = {};
  std::string channel = {};
  Range height{0, 1000};  ///< m
  PictureValues values = PictureValues::automatic;
  Transfer transfer = Transfer::as_stored;
  float size = 0;  ///< m, west to east, around the terrain's middle; 0: the whole terrain
  ByteOrder byte_order = ByteOrder::little;  ///< of RAW16
  bool flip = false;                         ///< of RAW16: rows begin in the south
  int raw_width = 0;                         ///< pixels of RAW16; 0: a square
};

Description<Import> describe(const Import&);

/// Throws Error(input) without a file, for what is no picture and for an unknown channel.
Heightfield import_picture(const Heightfield& input, const Import& parameters,
                           const TerrainContext& context);

/// The names under which an exported picture records the heights of 0 and 1, m.
inline constexpr const char* low_height_key = "wold_low_height";
inline constexpr const char* high_height_key = "wold_high_height";

/// One channel of a picture (by name; empty: the first) laid over a rectangle of the world.
Grid<float> picture_over(const std::filesystem::path& path, const std::string& channel,
                         const TerrainDomain& place, const Heightfield& like, Progress& progress);

}  // namespace wold
