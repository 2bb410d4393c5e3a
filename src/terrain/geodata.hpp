#pragma once
// Elevation data through GDAL, where wold was built with it.

#include <optional>
#include <string>

#include "terrain/elevation.hpp"

namespace wold {

/// The data, or nothing if the file has no place on Earth (a plain picture). Throws as
/// `read_elevation`.
std::optional<Elevation> read_geodata(const std::string& path);

}  // namespace wold
