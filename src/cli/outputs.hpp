#pragma once
// What the commands that make land have in common: its files, its maps, its preview.

#include <string>
#include <vector>

#include "cli/delivery.hpp"
#include "cli/session.hpp"
#include "terrain/export.hpp"
#include "terrain/operator.hpp"

namespace CLI {
class App;
}

namespace wold {

/// What may be written besides the land itself. Empty names are none.
struct SideOutputs {
  std::string maps;           ///< folder
  bool map_pictures = false;  ///< each map as PNG too
  std::string preview;        ///< picture of the land in slanting light

  /// Adds --maps, --map-pictures and --preview.
  void add_to(CLI::App& command);
  /// To be called before long work. Throws Error(usage) or Error(io).
  void check() const;
  /// Writes the maps of the steps with slope and curvature, which every material in an engine
  /// wants, and the preview. Returns the paths of the maps.
  std::vector<std::string> write(const TerrainResult& terrain, Delivery& delivery,
                                 const Session& session) const;
};

Json json_of(const ExportReport& report);
/// What was moved, added and removed, for --json.
Json json_of(const std::vector<Balance>& balances);

/// "wrote h.exr: EXR, 32-bit floats, 513 x 513 samples, …"
std::string told(const ExportReport& report);

}  // namespace wold
