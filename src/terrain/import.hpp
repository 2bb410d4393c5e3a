#pragma once
// Ground from a picture or elevation data: a height map made elsewhere.
//
// The picture lies over the terrain with north up; its outermost pixels' centres lie on the
// terrain's border, so a map of 2^n + 1 pixels fits samples exactly. Between pixels it is bicubic;
// where the terrain is coarser, the picture is smoothed to its spacing first. Beyond its border the
// nearest height goes on.
//
// Heights of pictures with integers (PNG, most TIFF, RAW16) fill a range of metres: the one that
// wold recorded in the file, or the parameter `height`. Those of pictures with floats (EXR, float
// TIFF) are metres already. Pixels without a number (NaN, infinity) get the lowest height.
//
// Elevation data (elevation.hpp) know their heights and their size: they lie around the terrain's
// middle as large as they are, unless `size` says otherwise.

#include "terrain/elevation.hpp"
#include "terrain/operator.hpp"

namespace wold {

struct Import {
  FilePath file = {};
  std::string channel = {};
  Range height{0, 1000};  ///< m
  PictureValues values = PictureValues::automatic;
  Transfer transfer = Transfer::as_stored;
  float size =
      0;  ///< m, west to east, around the terrain's middle; 0: its own, or the whole terrain
  ByteOrder byte_order = ByteOrder::little;  ///< of RAW16
  bool flip = false;                         ///< of RAW16: rows begin in the south
  int raw_width = 0;                         ///< pixels of RAW16; 0: a square
};

Description<Import> describe(const Import&);

/// Throws Error(input) without a file, for what is no picture and for an unknown channel.
Heightfield import_picture(const Heightfield& input, const Import& parameters,
                           const TerrainContext& context);

/// One channel of a picture (by name; empty: the first) laid over a rectangle of the world.
Grid<float> picture_over(const std::filesystem::path& path, const std::string& channel,
                         const TerrainDomain& place, const Heightfield& like, Progress& progress);

}  // namespace wold
