#include "terrain/elevation.hpp"

#include <fstream>
#include <numbers>

#include "image/io.hpp"
#include "terrain/export.hpp"
#include "testing.hpp"

#ifdef WOLD_GDAL
#include <gdal.h>
#include <ogr_srs_api.h>
#endif

namespace wold {
namespace {

using namespace testing_terrain;

TEST(Elevation, TakesBackWhatWasExported) {
  const TemporaryFolder folder;
  const Heightfield field =
      field_of(9, 7, 25, {0, 0}, [](DVec2 p) { return 300 + 0.5 * p.x - 0.25 * p.y; });
  for (const char* name : {"h.exr", "h.tif", "h.png"}) {
    export_heightfield(field, folder.file(name));
    const Elevation read = read_elevation(folder.file(name));
    EXPECT_EQ(read.spacing, DVec2(25)) << name;
    EXPECT_TRUE(read.knows_heights) << name;
    EXPECT_FALSE(read.georeferenced) << name;
    EXPECT_LT(largest_difference(read.height, field.height), 0.003F) << name;
  }
}

TEST(Elevation, SaysWhatAPlainPictureDoesNotTell) {
  const TemporaryFolder folder;
  Image image(3, 2, {"Y"});
  image.pixels = {0, 0.5F, 1, 1, 0.5F, 0};
  write_png(folder.file("plain.png"), image);
  const Elevation read = read_elevation(folder.file("plain.png"), {.height = {100, 300}});
  EXPECT_EQ(read.spacing, DVec2(0));
  EXPECT_FALSE(read.knows_heights);
  EXPECT_NEAR(read.height(2, 1), 300, 0.01F);
}

TEST(Elevation, ResamplesCellsThatAreNotSquare) {
  Elevation elevation;
  elevation.height = field_of(41, 61, 1, {0, 0}, [](DVec2 p) {
                       return 3 * p.x + 2 * p.y;  // 3 m per sample east, 2 m north
                     }).height;
  elevation.spacing = {30, 20};  // slopes 0.1 and 0.1
  Progress progress;
  const Heightfield field = square_field(elevation, progress);
  EXPECT_EQ(field.cell, 20);
  EXPECT_EQ(field.height.width(), 61);
  EXPECT_EQ(field.height.height(), 61);
  EXPECT_EQ(field.origin, DVec2(-600, -600));
  EXPECT_NEAR(field.height(30, 30), 60 + 60, 1e-3F);
  EXPECT_NEAR(field.height(45, 20) - field.height(15, 20), 60, 1e-2F);
}

TEST(Elevation, MissingFile) {
  EXPECT_EQ(error_text([] { read_elevation("nowhere.hgt"); }, ErrorKind::io),
            "'nowhere.hgt' does not exist");
}

#ifdef WOLD_GDAL

/// A tile of the Shuttle Radar Topography Mission: 1201 x 1201 big-endian integers, north first.
void write_hgt(const std::string& path, const std::function<int(int column, int row)>& height) {
  constexpr int side = 1201;
  std::string bytes;
  for (int row = 0; row < side; ++row)
    for (int column = 0; column < side; ++column) {
      const auto h = static_cast<std::uint16_t>(height(column, row));
      bytes.push_back(static_cast<char>(h >> 8U));
      bytes.push_back(static_cast<char>(h & 0xffU));
    }
  std::ofstream(path, std::ios::binary) << bytes;
}

TEST(Elevation, ReadsHgtWithItsVoidsFilled) {
  const TemporaryFolder folder;
  write_hgt(folder.file("N46E008.hgt"), [](int column, int row) {
    const bool is_void = column > 300 && column < 310 && row > 400 && row < 410;
    return is_void ? -32768 : 1000 + row;  // higher in the south
  });
  const Elevation read = read_elevation(folder.file("N46E008.hgt"));
  EXPECT_EQ(read.format, "SRTMHGT");
  EXPECT_TRUE(read.georeferenced);
  EXPECT_EQ(read.height.width(), 1201);
  EXPECT_EQ(read.filled, 81U);
  EXPECT_EQ(read.height(7, 0), 2200);     // the south-west corner's neighbour
  EXPECT_EQ(read.height(7, 1200), 1000);  // the north
  EXPECT_NEAR(read.height(305, 1200 - 405), 1405, 3);
  // Three seconds of arc at 46.5 degrees north: a degree is 76.8 km and 111.2 km there.
  EXPECT_NEAR(read.spacing.x, 76.80e3 / 1200, 0.1);
  EXPECT_NEAR(read.spacing.y, 111.16e3 / 1200, 0.1);
}

TEST(Elevation, ImportLaysDataAsLargeAsTheyAre) {
  const TemporaryFolder folder;
  write_hgt(folder.file("N46E008.hgt"), [](int column, int) { return column; });
  TerrainSettings settings;
  settings.size = 10000;
  settings.resolution = 101;
  const TerrainResult result = Steps()
                                   .add("import", {{"file", std::string("N46E008.hgt")}})
                                   .evaluate(settings, 1, folder.path());
  // 10 km in the middle of 76.8 km: 156 of the 1200 columns.
  EXPECT_NEAR(result.field.height(50, 50), 600, 0.5F);
  EXPECT_NEAR(result.field.height(100, 50) - result.field.height(0, 50), 156.2, 1.0);
}

void write_geotiff(const std::string& path, std::array<double, 6> place, const char* system,
                   const char* unit = "") {
  GDALAllRegister();
  GDALDatasetH dataset =
      GDALCreate(GDALGetDriverByName("GTiff"), path.c_str(), 4, 3, 1, GDT_Float32, nullptr);
  GDALSetGeoTransform(dataset, place.data());
  OGRSpatialReferenceH reference = OSRNewSpatialReference(nullptr);
  OSRSetFromUserInput(reference, system);
  GDALSetSpatialRef(dataset, reference);
  std::array<float, 12> heights{10, 11, 12, 13, 20, 21, 22, 23, 30, 31, 32, -9999};
  GDALRasterBandH band = GDALGetRasterBand(dataset, 1);
  GDALSetRasterNoDataValue(band, -9999);
  GDALSetRasterUnitType(band, unit);
  EXPECT_EQ(GDALRasterIO(band, GF_Write, 0, 0, 4, 3, heights.data(), 4, 3, GDT_Float32, 0, 0),
            CE_None);
  OSRDestroySpatialReference(reference);
  GDALClose(dataset);
}

TEST(Elevation, ReadsGeoTiff) {
  const TemporaryFolder folder;
  write_geotiff(folder.file("utm.tif"), {500000, 30, 0, 5200000, 0, -30}, "EPSG:32632");
  const Elevation read = read_elevation(folder.file("utm.tif"));
  EXPECT_EQ(read.format, "GTiff");
  EXPECT_EQ(read.spacing, DVec2(30));
  EXPECT_EQ(read.height(0, 0), 30);
  EXPECT_EQ(read.height(1, 2), 11);
  EXPECT_EQ(read.filled, 1U);
  EXPECT_NEAR(read.height(3, 0), 28, 5);
}

TEST(Elevation, FeetBecomeMetres) {
  const TemporaryFolder folder;
  write_geotiff(folder.file("feet.tif"), {0, 100, 0, 0, 0, -100}, "EPSG:2225", "ft");
  const Elevation read = read_elevation(folder.file("feet.tif"));
  EXPECT_NEAR(read.spacing.x, 30.48, 0.001);
  EXPECT_NEAR(read.height(0, 2), 3.048F, 1e-4F);
}

TEST(Elevation, RefusesWhatIsAskewOrBroken) {
  const TemporaryFolder folder;
  write_geotiff(folder.file("askew.tif"), {0, 20, 5, 0, 5, -20}, "EPSG:32632");
  EXPECT_NE(error_text([&] { read_elevation(folder.file("askew.tif")); }).find("lies askew"),
            std::string::npos);
  std::ofstream(folder.file("N46E008.hgt")) << "short";
  EXPECT_NE(error_text([&] {
              read_elevation(folder.file("N46E008.hgt"));
            }).find("no elevation data that can be read"),
            std::string::npos);
}

TEST(Elevation, AnSrtmFileOfAnotherNameIsToldHowTheyAreNamed) {
  const TemporaryFolder folder;
  const std::string file = folder.file("alps.hgt");
  std::ofstream(file, std::ios::binary) << std::string(std::size_t{2} * 1201 * 1201, '\0');
  EXPECT_EQ(error_text([&] { read_elevation(file); }),
            file +
                ": no elevation data that can be read; an SRTM file is named for its place, such "
                "as N46E008.hgt, and has 1201 x 1201, 3601 x 1801 or 3601 x 3601 heights");
}

#endif

}  // namespace
}  // namespace wold
