#pragma once
// What the commands that make land have in common: its files, its maps, its preview.

#include <string>

#include "cli/session.hpp"
#include "terrain/export.hpp"
#include "terrain/operator.hpp"

namespace wold {

/// Slope and curvature besides what the steps made: what every material in an engine wants.
std::map<std::string, Grid<float>> all_maps(const TerrainResult& terrain);

/// To be called before long work. The folder may be missing; an empty name is none. Throws
/// Error(io).
void check_map_folder(const std::string& folder);

/// To be called before long work; an empty name is none. Throws Error(usage) or Error(io).
void check_preview(const std::string& path);

/// The land in slanting light.
void write_preview(const std::string& path, const Heightfield& field);

Json json_of(const ExportReport& report);
/// What was moved, added and removed, for --json.
Json json_of(const std::vector<Balance>& balances);

/// "wrote h.exr: EXR, 32-bit floats, 513 x 513 samples, …"
std::string told(const ExportReport& report);

}  // namespace wold
