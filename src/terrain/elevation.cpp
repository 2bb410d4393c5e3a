#include "terrain/elevation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <optional>

#include "image/atomic_file.hpp"
#include "terrain/geodata.hpp"
#include "terrain/resample.hpp"

namespace wold {

namespace {

bool is_raw16(const std::string& path) {
  const std::string extension = extension_of(path);
  return extension == ".r16" || extension == ".raw";
}

Picture read_raw16_picture(const std::string& path, const ElevationOptions& options) {
  const Raw16Options raw{.order = options.byte_order, .flip = options.flip};
  const auto samples = static_cast<int>(read_file(path).size() / 2);
  const int rows = options.raw_width == 0 ? 0 : samples / options.raw_width;
  Picture picture;
  picture.image = read_raw16(path, options.raw_width, rows, raw);
  picture.bits = 16;
  return picture;
}

/// A number that wold wrote into the file.
std::optional<float> recorded(const Picture& picture, const char* key) {
  const auto found = picture.metadata.find(key);
  if (found == picture.metadata.end()) return std::nullopt;
  const float value = std::strtof(found->second.c_str(), nullptr);
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

std::optional<Range> recorded_range(const Picture& picture) {
  const auto low = recorded(picture, low_height_key);
  const auto high = recorded(picture, high_height_key);
  if (!low || !high) return std::nullopt;
  return Range{*low, *high};
}

Grid<float> channel_of(const Image& image, const std::string& channel) {
  return channel.empty() ? channel_grid(image, 0) : channel_grid(image, channel);
}

/// Heights of 0 and 1, and whether the file tells them.
std::pair<Range, bool> height_range(const Picture& picture, const ElevationOptions& options) {
  constexpr Range metres{0, 1};
  if (options.values == PictureValues::metres) return {metres, true};
  if (options.values == PictureValues::range) return {options.height, true};
  if (picture.floating) return {metres, true};
  if (const auto range = recorded_range(picture)) return {*range, true};
  return {options.height, false};
}

Elevation of_picture(const Picture& picture, const ElevationOptions& options) {
  Elevation out;
  out.height = channel_of(picture.image, options.channel);
  const auto [range, known] = height_range(picture, options);
  for (float& h : out.height.values()) h = range.low + h * (range.high - range.low);
  out.knows_heights = known;
  if (!picture.floating) out.range = range;
  const auto cell = recorded(picture, cell_key);
  if (cell && *cell > 0) out.spacing = DVec2(static_cast<double>(*cell));
  return out;
}

}  // namespace

Elevation read_elevation(const std::string& path, const ElevationOptions& options) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored))
    throw Error(ErrorKind::io, fmt::format("'{}' does not exist", path));
  if (is_raw16(path)) {
    Elevation out = of_picture(read_raw16_picture(path, options), options);
    out.format = "raw integers";
    return out;
  }
  if (std::optional<Elevation> data = read_geodata(path)) return std::move(*data);
  Elevation out = of_picture(read_picture(path, options.transfer), options);
  out.format = "picture";
  return out;
}

Heightfield square_field(const Elevation& elevation, Progress& progress) {
  const Grid<float>& height = elevation.height;
  const DVec2 size = elevation.spacing * DVec2(height.width() - 1, height.height() - 1);
  Heightfield field;
  field.cell = std::min(elevation.spacing.x, elevation.spacing.y);
  field.origin = -0.5 * size;
  const double difference = std::abs(elevation.spacing.x / elevation.spacing.y - 1);
  // Across the whole field less than half a cell: not worth resampling.
  if (difference * std::max(height.width(), height.height()) < 0.5) {
    field.height = height;
    return field;
  }
  const IVec2 samples(size / field.cell + 1.0);
  field.height = Grid<float>(samples.x, samples.y);
  field.height = resample(height, {field.origin, size}, Outside::clamp, field, progress);
  return field;
}

}  // namespace wold
