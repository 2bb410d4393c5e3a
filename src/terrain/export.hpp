#pragma once
// Heightfields to files: for other programs, and for engines with the numbers to type in there.
//
//   .exr .tif .tiff       floats, metres
//   .png .r16 .raw        16-bit integers: 0 is the lowest height of the range, 65535 the highest
//   .obj .ply .glb        a mesh (mesh_of.hpp), metres
//
// Pictures have north up. PNG, EXR and TIFF record range, cell and place as metadata, from which
// the operator `import` takes the range back. Files are whole or not there.

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/parameters.hpp"
#include "image/io.hpp"
#include "terrain/heightfield.hpp"

namespace wold {

struct ExportOptions {
  std::optional<Range> range = {};           ///< m, of integers; default: lowest and highest ground
  ByteOrder byte_order = ByteOrder::little;  ///< of RAW16
  bool flip = false;                         ///< RAW16: the first row is the south
};

/// What was written, and what its user must know.
struct ExportReport {
  std::string path;
  std::string format;    ///< "16-bit PNG", "mesh"
  int width = 0;         ///< samples west to east
  int height = 0;        ///< samples south to north
  double cell = 0;       ///< m
  Range range;           ///< m; of integers what 0 and 65535 mean, else lowest and highest ground
  double precision = 0;  ///< m between neighbouring integers; 0 of floats
  /// Settings by their names in the engine, in the order of its dialog; empty without an engine.
  std::vector<std::pair<std::string, std::string>> settings;
};

/// By extension. Throws Error(usage) for an unknown extension, Error(io), Error(limit).
ExportReport export_heightfield(const Heightfield& field, const std::string& path,
                                const ExportOptions& options = {});

/// The extensions that `export_heightfield` knows.
const std::vector<std::string>& export_extensions();

/// To be called before long work: throws unless `path` could be written.
void check_export(const std::string& path);

/// Writes each map as FOLDER/NAME.exr, and makes the folder; maps NAME.red, NAME.green and
/// NAME.blue become one picture. With `pictures` each is also written as FOLDER/NAME.png: its least
/// value black and its greatest white (colours as they are). Returns the paths.
std::vector<std::string> export_maps(const std::map<std::string, Grid<float>>& maps,
                                     const std::string& folder, bool pictures = false);

}  // namespace wold
