#include "terrain/import.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "terrain/resample.hpp"

namespace wold {

namespace {

void fill_holes(Grid<float>& grid) {
  float lowest = std::numeric_limits<float>::max();
  for (const float v : grid.values())
    if (std::isfinite(v)) lowest = std::min(lowest, v);
  if (lowest == std::numeric_limits<float>::max()) lowest = 0;
  for (float& v : grid.values())
    if (!std::isfinite(v)) v = lowest;
}

/// Metres between samples, east and north; 0 where they must cover the whole terrain.
DVec2 spacing_of(const Elevation& elevation, float size) {
  const Grid<float>& height = elevation.height;
  const double intervals = std::max(1, height.width() - 1);
  if (size > 0 && elevation.georeferenced)
    return elevation.spacing * (static_cast<double>(size) / (intervals * elevation.spacing.x));
  if (size > 0) return DVec2(static_cast<double>(size) / intervals);
  return elevation.georeferenced ? elevation.spacing : DVec2(0);
}

/// Around the middle of the terrain.
TerrainDomain place_of_heights(const Elevation& elevation, float size,
                               const TerrainDomain& terrain) {
  const DVec2 spacing = spacing_of(elevation, size);
  if (spacing.x <= 0) return terrain;
  const Grid<float>& height = elevation.height;
  const DVec2 extent =
      spacing * DVec2(std::max(1, height.width() - 1), std::max(1, height.height() - 1));
  return {terrain.center() - 0.5 * extent, extent};
}

}  // namespace

Description<Import> describe(const Import&) {
  using I = Import;
  return Description<I>("import", "Heights from a picture or from elevation data, north up.")
      .add("file", &I::file,
           "EXR, PNG, TIFF, JPEG, raw 16-bit integers (.r16, .raw), or elevation data (GeoTIFF, "
           ".hgt).")
      .add("channel", &I::channel, "Name of the channel; default: the first.")
      .add("height", &I::height, {.unit = "m", .min = -20000, .max = 20000},
           "Heights of black and white, for pictures that do not tell.")
      .choice("values", &I::values, {"automatic", "range", "metres"},
              "What the numbers are; automatic: metres in floats, else a range.")
      .choice("transfer", &I::transfer, {"stored", "if_tagged", "srgb"},
              "Whether the sRGB curve is undone: never, where the file says sRGB, or always.")
      .add("size", &I::size, {.unit = "m", .min = 0, .max = 1e6},
           "Extent from west to east; 0: that of elevation data, or the whole terrain.")
      .choice("byte_order", &I::byte_order, {"little", "big"}, "Of raw 16-bit files.")
      .add("flip", &I::flip, "Raw 16-bit files whose first row is the south.")
      .add("raw_width", &I::raw_width, {.unit = "pixels", .min = 0, .max = 1e6},
           "Width of raw 16-bit files; 0 for a square.");
}

Heightfield import_picture(const Heightfield& input, const Import& parameters,
                           const TerrainContext& context) {
  if (parameters.file.empty()) throw Error(ErrorKind::input, "'import' needs a 'file'");
  const std::string path = (context.folder / parameters.file.path).string();
  const auto& p = parameters;
  Elevation elevation = read_elevation(
      path, {p.channel, p.height, p.values, p.transfer, p.byte_order, p.flip, p.raw_width});
  fill_holes(elevation.height);
  return {resample(elevation.height, place_of_heights(elevation, p.size, context.domain),
                   Outside::clamp, input, context.progress),
          input.origin, input.cell};
}

Grid<float> picture_over(const std::filesystem::path& path, const std::string& channel,
                         const TerrainDomain& place, const Heightfield& like, Progress& progress) {
  const Picture picture = read_picture(path.string());
  Grid<float> values =
      channel.empty() ? channel_grid(picture.image, 0) : channel_grid(picture.image, channel);
  fill_holes(values);
  return resample(values, place, Outside::clamp, like, progress);
}

}  // namespace wold
