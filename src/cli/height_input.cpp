#include "cli/height_input.hpp"

#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <charconv>
#include <cmath>

#include "base/error.hpp"
#include "cli/session.hpp"

namespace wold {

namespace {

std::optional<double> number_of(std::string_view text) {
  double value = 0;
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (failure != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
    return std::nullopt;
  return value;
}

/// "a<sign>b", or "b" alone, which is after 0.
std::optional<DVec2> pair_of(const std::string& text, char sign) {
  const std::size_t middle = text.find(sign, 1);
  if (middle == std::string::npos) {
    const auto alone = number_of(text);
    if (!alone) return std::nullopt;
    return DVec2(0, *alone);
  }
  const auto first = number_of(std::string_view(text).substr(0, middle));
  const auto second = number_of(std::string_view(text).substr(middle + 1));
  if (!first || !second) return std::nullopt;
  return DVec2(*first, *second);
}

/// Width and, if given, depth; the depth is 0 otherwise.
DVec2 size_of(const std::string& text) {
  const auto size = pair_of(text, 'x');
  const bool both = text.find('x') != std::string::npos;
  if (!size || size->y <= 0 || (both && size->x <= 0))
    throw Error(ErrorKind::usage,
                fmt::format("'--size {}' must be metres, such as 4000 or 4000x3000", text));
  return both ? *size : DVec2(size->y, 0);
}

Range height_of(const std::string& text) {
  const auto range = pair_of(text, ':');
  if (!range || range->y <= range->x)
    throw Error(ErrorKind::usage,
                fmt::format("'--height {}' must be metres, such as 1500 or 200:1700", text));
  return {static_cast<float>(range->x), static_cast<float>(range->y)};
}

/// Metres between samples as --size has them. Throws for cells that are not square.
DVec2 spacing_of(const std::string& text, const Grid<float>& height) {
  const DVec2 size = size_of(text);
  const DVec2 intervals(std::max(1, height.width() - 1), std::max(1, height.height() - 1));
  const double cell = size.x / intervals.x;
  const double cell_north = size.y > 0 ? size.y / intervals.y : cell;
  const double longest = std::max(intervals.x, intervals.y);
  if (std::abs(cell_north / cell - 1) * longest > 1)
    throw Error(
        ErrorKind::usage,
        fmt::format("'--size {}' gives cells of {:.4g} x {:.4g} m on {} x {} samples; cells "
                    "must be square, as with --size {:g}x{:g}",
                    text, cell, cell_north, height.width(), height.height(), size.x,
                    cell * intervals.y));
  return DVec2(cell);
}

}  // namespace

void HeightInputOptions::add_to(CLI::App& command) {
  command
      .add_option("--size", size,
                  "Extent of the height map, west to east, or both ways (4000x3000); needed where "
                  "the file does not tell")
      ->type_name("METRES");
  command
      .add_option("--height", height,
                  "Height of white above black (1500), or of both (200:1700), where a picture has "
                  "integers")
      ->type_name("METRES");
}

double width_of(const std::string& size) {
  const DVec2 both = size_of(size);
  return both.x;
}

HeightInput read_height_input(const std::string& path, const HeightInputOptions& options,
                              const Session& session) {
  ElevationOptions reading;
  if (!options.height.empty()) {
    reading.height = height_of(options.height);
    reading.values = PictureValues::range;
  }
  if (!options.size.empty()) size_of(options.size);
  Elevation elevation = read_elevation(path, reading);
  if (!options.size.empty()) elevation.spacing = spacing_of(options.size, elevation.height);
  if (elevation.spacing.x <= 0)
    throw Error(ErrorKind::usage,
                fmt::format("'{}' does not tell how large it is; say it in metres, as with --size "
                            "4000",
                            path));
  if (!elevation.knows_heights)
    session.say(
        fmt::format("{} does not tell its heights: black is taken as {:g} m, white as {:g} m "
                    "(--height)",
                    path, reading.height.low, reading.height.high));
  if (elevation.filled > 0)
    session.say(fmt::format("{} samples without data were filled from around", elevation.filled));
  Progress progress = session.progress();
  Heightfield field = square_field(elevation, progress);
  session.say(fmt::format("{}: {}, {} x {} samples, {:.4g} m apart", path, elevation.format,
                          field.height.width(), field.height.height(), field.cell));
  return {std::move(field), elevation.range};
}

}  // namespace wold
