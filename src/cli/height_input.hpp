#pragma once
// The height map that a command is given, and the options that say what it does not tell itself.

#include <optional>
#include <string>

#include "terrain/elevation.hpp"

namespace CLI {
class App;
}

namespace wold {

struct Session;

struct HeightInputOptions {
  std::string size;    ///< m: "4000" west to east, or "4000x3000"
  std::string height;  ///< m: "1500", or "200:1700"

  void add_to(CLI::App& command);
};

/// Metres west to east of --size. Throws Error(usage).
double width_of(const std::string& size);

struct HeightInput {
  Heightfield field;
  std::optional<Range> range;  ///< m, of black and white, if it was a picture of integers
};

/// Reads heights with their metres. Says on standard error what it made of the file. Throws as
/// `read_elevation`; Error(usage) where the file does not tell its size and no option does, and
/// for cells that are not square.
HeightInput read_height_input(const std::string& path, const HeightInputOptions& options,
                              const Session& session);

}  // namespace wold
