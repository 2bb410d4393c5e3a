#include "terrain/import.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>

#include "image/atomic_file.hpp"
#include "terrain/resample.hpp"

namespace wold {

namespace {

bool is_raw16(const std::string& path) {
  const std::string extension = extension_of(path);
  return extension == ".r16" || extension == ".raw";
}

Picture read_raw16_picture(const std::string& path, const Import& p) {
  const Raw16Options options{.order = p.byte_order, .flip = p.flip};
  const auto samples = static_cast<int>(read_file(path).size() / 2);
  const int rows = p.raw_width == 0 ? 0 : samples / p.raw_width;
  Picture picture;
  picture.image = read_raw16(path, p.raw_width, rows, options);
  picture.bits = 16;
  return picture;
}

/// The heights of 0 and 1 that wold wrote into the file.
std::optional<Range> recorded_range(const Picture& picture) {
  const auto low = picture.metadata.find(low_height_key);
  const auto high = picture.metadata.find(high_height_key);
  if (low == picture.metadata.end() || high == picture.metadata.end()) return std::nullopt;
  return Range{std::strtof(low->second.c_str(), nullptr),
               std::strtof(high->second.c_str(), nullptr)};
}

Range height_range(const Picture& picture, const Import& p) {
  constexpr Range metres{0, 1};
  if (p.values == PictureValues::metres) return metres;
  if (p.values == PictureValues::range) return p.height;
  if (picture.floating) return metres;
  return recorded_range(picture).value_or(p.height);
}

void fill_holes(Grid<float>& grid) {
  float lowest = std::numeric_limits<float>::max();
  for (const float v : grid.values())
    if (std::isfinite(v)) lowest = std::min(lowest, v);
  if (lowest == std::numeric_limits<float>::max()) lowest = 0;
  for (float& v : grid.values())
    if (!std::isfinite(v)) v = lowest;
}

Grid<float> channel_of(const Image& image, const std::string& channel) {
  return channel.empty() ? channel_grid(image, 0) : channel_grid(image, channel);
}

/// The picture's own proportions, around the middle of the terrain.
TerrainDomain place_of_picture(const Grid<float>& heights, float size,
                               const TerrainDomain& terrain) {
  if (size <= 0) return terrain;
  const double cell = static_cast<double>(size) / std::max(1, heights.width() - 1);
  const DVec2 extent =
      cell * DVec2(std::max(1, heights.width() - 1), std::max(1, heights.height() - 1));
  return {terrain.center() - 0.5 * extent, extent};
}

}  // namespace

Description<Import> describe(const Import&) {
  using I = Import;
  return Description<I>("import", "Heights from a picture, north up.")
      .add("file", &I::file, "EXR, PNG, TIFF, JPEG, or raw 16-bit integers (.r16, .raw).")
      .add("channel", &I::channel, "Name of the channel; default: the first.")
      .add("height", &I::height, {.unit = "m", .min = -20000, .max = 20000},
           "Heights of black and white, for pictures that do not tell.")
      .choice("values", &I::values, {"automatic", "range", "metres"},
              "What the numbers are; automatic: metres in floats, else a range.")
      .choice("transfer", &I::transfer, {"stored", "if_tagged", "srgb"},
              "Whether the sRGB curve is undone: never, where the file says sRGB, or always.")
      .add("size", &I::size, {.unit = "m", .min = 0, .max = 1e6},
           "Extent from west to east; 0 lays the picture over the whole terrain.")
      .choice("byte_order", &I::byte_order, {"little", "big"}, "Of raw 16-bit files.")
      .add("flip", &I::flip, "Raw 16-bit files whose first row is the south.")
      .add("raw_width", &I::raw_width, {.unit = "pixels", .min = 0, .max = 1e6},
           "Width of raw 16-bit files; 0 for a square.");
}

Heightfield import_picture(const Heightfield& input, const Import& parameters,
                           const TerrainContext& context) {
  if (parameters.file.empty()) throw Error(ErrorKind::input, "'import' needs a 'file'");
  const std::string path = (context.folder / parameters.file.path).string();
  const Picture picture = is_raw16(path) ? read_raw16_picture(path, parameters)
                                         : read_picture(path, parameters.transfer);
  Grid<float> heights = channel_of(picture.image, parameters.channel);
  const Range range = height_range(picture, parameters);
  for (float& h : heights.values()) h = range.low + h * (range.high - range.low);
  fill_holes(heights);
  return {resample(heights, place_of_picture(heights, parameters.size, context.domain),
                   Outside::clamp, input, context.progress),
          input.origin, input.cell};
}

Grid<float> picture_over(const std::filesystem::path& path, const std::string& channel,
                         const TerrainDomain& place, const Heightfield& like, Progress& progress) {
  Grid<float> values = channel_of(read_picture(path.string()).image, channel);
  fill_holes(values);
  return resample(values, place, Outside::clamp, like, progress);
}

}  // namespace wold
