#include "terrain/export.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <set>

#include "image/atomic_file.hpp"
#include "image/color.hpp"
#include "mesh/io.hpp"
#include "terrain/analysis.hpp"
#include "terrain/import.hpp"
#include "terrain/mesh_of.hpp"

namespace wold {

namespace {

enum class Format { exr, tiff, png16, raw16, mesh };

Format format_of(const std::string& path) {
  const std::string extension = extension_of(path);
  if (extension == ".exr") return Format::exr;
  if (extension == ".tif" || extension == ".tiff") return Format::tiff;
  if (extension == ".png") return Format::png16;
  if (extension == ".r16" || extension == ".raw") return Format::raw16;
  const auto& meshes = mesh_extensions();
  if (std::find(meshes.begin(), meshes.end(), extension) != meshes.end()) return Format::mesh;
  throw Error(ErrorKind::usage,
              fmt::format("'{}' does not say in which format heights are wanted; known: {}", path,
                          fmt::join(export_extensions(), ", ")));
}

const char* format_name(Format format) {
  switch (format) {
    case Format::exr: return "EXR, 32-bit floats";
    case Format::tiff: return "TIFF, 32-bit floats";
    case Format::png16: return "PNG, 16-bit integers";
    case Format::raw16: return "RAW, 16-bit integers";
    case Format::mesh: break;
  }
  return "mesh";
}

bool has_integers(Format format) {
  return format == Format::png16 || format == Format::raw16;
}

Range range_of(const Heightfield& field, Format format, const ExportOptions& options) {
  const HeightStatistics statistics = height_statistics(field);
  Range range{statistics.min, statistics.max};
  if (!has_integers(format)) return range;
  if (options.range) range = *options.range;
  if (range.high <= range.low) range.high = range.low + 1;
  return range;
}

Metadata metadata_of(const Heightfield& field, const Range& range) {
  return {{low_height_key, fmt::format("{}", range.low)},
          {high_height_key, fmt::format("{}", range.high)},
          {cell_key, fmt::format("{}", field.cell)},
          {"wold_origin", fmt::format("{} {}", field.origin.x, field.origin.y)}};
}

/// Heights with the ends of the range at 0 and 1.
Image normalised(const Heightfield& field, const Range& range) {
  Image image = image_of(field.height);
  const float scale = 1 / (range.high - range.low);
  for (float& h : image.pixels) h = std::clamp((h - range.low) * scale, 0.0F, 1.0F);
  return image;
}

constexpr const char* red_suffix = ".red";

/// Pictures by name: one channel each, or red, green and blue where there are such maps.
std::map<std::string, Image> map_images(const std::map<std::string, Grid<float>>& maps) {
  std::map<std::string, Image> images;
  std::set<std::string> colors;
  for (const auto& [name, red] : maps) {
    if (!name.ends_with(red_suffix)) continue;
    const std::string stem = name.substr(0, name.size() - std::strlen(red_suffix));
    const auto green = maps.find(stem + ".green");
    const auto blue = maps.find(stem + ".blue");
    if (green == maps.end() || blue == maps.end()) continue;
    Image image(red.width(), red.height(), {"R", "G", "B"});
    set_channel(image, 0, red);
    set_channel(image, 1, green->second);
    set_channel(image, 2, blue->second);
    images.emplace(stem, std::move(image));
    colors.insert({name, green->first, blue->first});
  }
  for (const auto& [name, map] : maps)
    if (!colors.contains(name)) images.emplace(name, image_of(map));
  return images;
}

Image from_black_to_white(Image image) {
  const auto [low, high] = std::minmax_element(image.pixels.begin(), image.pixels.end());
  const float offset = *low;
  const float scale = *high > *low ? 1 / (*high - *low) : 0;
  for (float& v : image.pixels) v = (v - offset) * scale;
  return image;
}

Image display_encoded(Image image) {
  for (float& v : image.pixels) v = linear_to_srgb(std::clamp(v, 0.0F, 1.0F));
  return image;
}

}  // namespace

ExportReport export_heightfield(const Heightfield& field, const std::string& path,
                                const ExportOptions& options) {
  const Format format = format_of(path);
  const Range range = range_of(field, format, options);
  const Metadata metadata = metadata_of(field, range);
  switch (format) {
    case Format::exr: write_exr(path, image_of(field.height), {{}, metadata}); break;
    case Format::tiff: write_tiff(path, image_of(field.height), metadata); break;
    case Format::png16:
      write_png(path, normalised(field, range), {16, false, false, metadata});
      break;
    case Format::raw16:
      write_raw16(path, normalised(field, range), {options.byte_order, options.flip});
      break;
    case Format::mesh: write_mesh(path, mesh_of(field)); break;
  }
  const double precision =
      has_integers(format) ? static_cast<double>(range.high - range.low) / 65535 : 0;
  return {path,
          format_name(format),
          field.height.width(),
          field.height.height(),
          field.cell,
          range,
          precision,
          {}};
}

const std::vector<std::string>& export_extensions() {
  static const std::vector<std::string> extensions{".exr", ".tif", ".tiff", ".png", ".r16",
                                                   ".raw", ".obj", ".ply",  ".glb"};
  return extensions;
}

void check_export(const std::string& path) {
  if (format_of(path) == Format::mesh)
    check_mesh_writable(path);
  else
    check_picture_writable(path);
}

std::vector<std::string> export_maps(const std::map<std::string, Grid<float>>& maps,
                                     const std::string& folder, bool pictures) {
  std::vector<std::string> paths;
  write_folder(folder, [&] {
    for (const auto& [name, image] : map_images(maps)) {
      const std::string path = (std::filesystem::path(folder) / name).string();
      paths.push_back(path + ".exr");
      write_exr(paths.back(), image);
      if (!pictures) continue;
      paths.push_back(path + ".png");
      if (image.channel_count() == 3)
        write_png(paths.back(), display_encoded(image), {.bits = 8, .srgb = true});
      else
        write_png(paths.back(), from_black_to_white(image), {.bits = 16});
    }
  });
  return paths;
}

}  // namespace wold
