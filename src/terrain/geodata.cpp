#include "terrain/geodata.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "image/atomic_file.hpp"

#ifdef WOLD_GDAL
#include <cpl_error.h>
#include <gdal.h>
#include <gdal_alg.h>
#include <ogr_srs_api.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "base/memory.hpp"
#endif

namespace wold {

namespace {

/// Files that are elevation data and no pictures.
bool is_elevation_format(const std::string& path) {
  constexpr std::array<const char*, 10> extensions{".hgt", ".asc", ".bil", ".dem", ".dt0",
                                                   ".dt1", ".dt2", ".grd", ".img", ".vrt"};
  const std::string extension = extension_of(path);
  return std::any_of(extensions.begin(), extensions.end(),
                     [&](const char* known) { return extension == known; });
}

/// Files that may be pictures or elevation data.
bool may_be_geodata(const std::string& path) {
  const std::string extension = extension_of(path);
  return is_elevation_format(path) || extension == ".tif" || extension == ".tiff";
}

}  // namespace

#ifdef WOLD_GDAL

namespace {

/// GDAL prints its complaints; what they say goes into our errors instead.
class QuietGdal {
 public:
  QuietGdal() {
    GDALAllRegister();
    CPLPushErrorHandler(CPLQuietErrorHandler);
    CPLErrorReset();
  }
  QuietGdal(const QuietGdal&) = delete;
  QuietGdal& operator=(const QuietGdal&) = delete;
  ~QuietGdal() { CPLPopErrorHandler(); }

  static std::string complaint() { return CPLGetLastErrorMsg(); }
};

/// `complaint` is GDAL's, and often empty.
Error unreadable(const std::string& path, const std::string& complaint) {
  std::string message = fmt::format("{}: no elevation data that can be read", path);
  if (!complaint.empty()) message += ": " + complaint;
  if (extension_of(path) == ".hgt")
    message +=
        "; an SRTM file is named for its place, such as N46E008.hgt, and has 1201 x 1201, 3601 x "
        "1801 or 3601 x 3601 heights";
  return {ErrorKind::input, message};
}

struct CloseDataset {
  void operator()(void* dataset) const { GDALClose(dataset); }
};
using Dataset = std::unique_ptr<void, CloseDataset>;

/// Metres of a degree of longitude and of latitude at a latitude, on the WGS 84 ellipsoid.
DVec2 metres_per_degree(double latitude_degrees) {
  constexpr double radian = std::numbers::pi / 180;
  constexpr double equatorial_radius = 6378137;
  constexpr double eccentricity_squared = 6.69437999014e-3;
  const double latitude = latitude_degrees * radian;
  const double w = 1 - eccentricity_squared * std::sin(latitude) * std::sin(latitude);
  const double prime_vertical = equatorial_radius / std::sqrt(w);
  const double meridian = prime_vertical * (1 - eccentricity_squared) / w;
  return radian * DVec2(prime_vertical * std::cos(latitude), meridian);
}

/// Metres of one unit of the coordinates at the middle of the data.
DVec2 metres_per_unit(GDALDatasetH dataset, double middle_y) {
  OGRSpatialReferenceH reference = GDALGetSpatialRef(dataset);
  if (reference == nullptr) return {1, 1};
  if (OSRIsGeographic(reference) != 0) return metres_per_degree(middle_y);
  return DVec2(OSRGetLinearUnits(reference, nullptr));
}

/// Metres of one unit of heights.
double height_unit(GDALRasterBandH band) {
  const std::string unit = GDALGetRasterUnitType(band);
  const bool feet = unit.find("ft") != std::string::npos ||
                    unit.find("foot") != std::string::npos ||
                    unit.find("feet") != std::string::npos;
  return feet ? 0.3048 : 1.0;
}

void check_fits(const std::string& path, int width, int height) {
  const double needed = 3.0 * sizeof(float) * width * height;
  const auto available = static_cast<double>(available_memory());
  if (available <= 0 || needed <= 0.9 * available) return;
  throw Error(ErrorKind::limit,
              fmt::format("{}: {} x {} samples need about {}, but {} are free", path, width, height,
                          memory_text(needed), memory_text(available)));
}

/// Fills what has no data from its surroundings, and says how much that was.
std::size_t fill_gaps(const std::string& path, GDALRasterBandH band, std::vector<float>& heights,
                      int width, int height) {
  std::vector<std::uint8_t> valid(heights.size());
  GDALRasterBandH mask = GDALGetMaskBand(band);
  if (GDALRasterIO(mask, GF_Read, 0, 0, width, height, valid.data(), width, height, GDT_Byte, 0,
                   0) != CE_None)
    throw Error(ErrorKind::io, fmt::format("{}: {}", path, QuietGdal::complaint()));
  std::size_t gaps = 0;
  for (std::size_t k = 0; k < heights.size(); ++k) {
    if (!std::isfinite(heights[k])) valid[k] = 0;
    if (valid[k] == 0) ++gaps;
  }
  if (gaps == 0) return 0;
  if (gaps == heights.size())
    throw Error(ErrorKind::input, fmt::format("{}: no sample has a height", path));
  GDALDriverH memory = GDALGetDriverByName("MEM");
  const Dataset copy(GDALCreate(memory, "", width, height, 2, GDT_Float32, nullptr));
  for (std::size_t k = 0; k < heights.size(); ++k)
    if (valid[k] == 0) heights[k] = 0;
  GDALRasterBandH values = GDALGetRasterBand(copy.get(), 1);
  GDALRasterBandH known = GDALGetRasterBand(copy.get(), 2);
  const bool done = GDALRasterIO(values, GF_Write, 0, 0, width, height, heights.data(), width,
                                 height, GDT_Float32, 0, 0) == CE_None &&
                    GDALRasterIO(known, GF_Write, 0, 0, width, height, valid.data(), width, height,
                                 GDT_Byte, 0, 0) == CE_None &&
                    GDALFillNodata(values, known, std::max(width, height), 0, 0, nullptr, nullptr,
                                   nullptr) == CE_None &&
                    GDALRasterIO(values, GF_Read, 0, 0, width, height, heights.data(), width,
                                 height, GDT_Float32, 0, 0) == CE_None;
  if (!done) throw Error(ErrorKind::io, fmt::format("{}: {}", path, QuietGdal::complaint()));
  return gaps;
}

/// GDAL's rows begin in the north.
Grid<float> turned_over(const std::vector<float>& rows, int width, int height) {
  Grid<float> out(width, height);
  for (int j = 0; j < height; ++j) {
    const auto begin = rows.begin() + static_cast<std::ptrdiff_t>(height - 1 - j) * width;
    std::copy_n(begin, width, out.row(j).begin());
  }
  return out;
}

Elevation read_band(const std::string& path, GDALDatasetH dataset,
                    const std::array<double, 6>& place) {
  const int width = GDALGetRasterXSize(dataset);
  const int height = GDALGetRasterYSize(dataset);
  if (GDALGetRasterCount(dataset) < 1)
    throw Error(ErrorKind::input, fmt::format("{}: holds no raster of heights", path));
  check_fits(path, width, height);
  GDALRasterBandH band = GDALGetRasterBand(dataset, 1);
  std::vector<float> heights(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  if (GDALRasterIO(band, GF_Read, 0, 0, width, height, heights.data(), width, height, GDT_Float32,
                   0, 0) != CE_None)
    throw Error(ErrorKind::io, fmt::format("{}: {}", path, QuietGdal::complaint()));

  Elevation out;
  out.filled = fill_gaps(path, band, heights, width, height);
  const double unit = height_unit(band);
  const double scale = unit * GDALGetRasterScale(band, nullptr);
  const double offset = unit * GDALGetRasterOffset(band, nullptr);
  for (float& h : heights) h = static_cast<float>(scale * static_cast<double>(h) + offset);
  out.height = turned_over(heights, width, height);
  const double middle_y = place[3] + place[5] * 0.5 * height;
  out.spacing = glm::abs(DVec2(place[1], place[5]) * metres_per_unit(dataset, middle_y));
  out.knows_heights = true;
  out.georeferenced = true;
  out.format = GDALGetDriverShortName(GDALGetDatasetDriver(dataset));
  return out;
}

}  // namespace

std::optional<Elevation> read_geodata(const std::string& path) {
  if (!may_be_geodata(path)) return std::nullopt;
  const QuietGdal quiet;
  const Dataset dataset(
      GDALOpenEx(path.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY, nullptr, nullptr, nullptr));
  if (dataset == nullptr) {
    if (!is_elevation_format(path)) return std::nullopt;
    throw unreadable(path, QuietGdal::complaint());
  }
  std::array<double, 6> place{};
  if (GDALGetGeoTransform(dataset.get(), place.data()) != CE_None) {
    if (!is_elevation_format(path)) return std::nullopt;
    throw Error(ErrorKind::input, fmt::format("{}: has no place on Earth", path));
  }
  if (place[2] != 0 || place[4] != 0)
    throw Error(
        ErrorKind::input,
        fmt::format("{}: lies askew to its map's north; bring it upright first, for example "
                    "with gdalwarp",
                    path));
  return read_band(path, dataset.get(), place);
}

#else

std::optional<Elevation> read_geodata(const std::string& path) {
  if (!is_elevation_format(path)) return std::nullopt;
  throw Error(
      ErrorKind::usage,
      fmt::format("{}: reading elevation data needs GDAL, which this wold was built without",
                  path));
}

#endif

}  // namespace wold
