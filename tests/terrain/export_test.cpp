#include "terrain/export.hpp"

#include <fstream>

#include "mesh/io.hpp"
#include "terrain/engine_export.hpp"
#include "terrain/mesh_of.hpp"
#include "testing.hpp"

namespace wold {
namespace {

using testing_terrain::error_text;
using testing_terrain::field_of;
using testing_terrain::largest_difference;
using testing_terrain::Steps;
using testing_terrain::TemporaryFolder;

/// Neither symmetric nor square, rising to the north-east.
Heightfield sample_field(int width = 33, int height = 17) {
  return field_of(width, height, 8, {-128, -64},
                  [](DVec2 p) { return 120 + 0.5 * p.x + 0.8 * p.y + 15 * std::sin(0.03 * p.x); });
}

Grid<float> imported(const TemporaryFolder& folder, const std::string& name,
                     std::initializer_list<std::pair<const char*, Value>> values = {}) {
  Steps steps;
  steps.add("import", {{"file", name}});
  auto list = steps.list();
  for (const auto& [key, value] : values) assign(list.front(), key, value);
  Progress progress;
  return evaluate({.size = 256, .size_north = 128, .resolution = 33}, list, steps.operators(), 1,
                  folder.path(), progress)
      .field.height;
}

TEST(Export, EveryPictureFormatComesBackToItsPrecision) {
  const TemporaryFolder folder;
  const Heightfield field = sample_field();
  for (const char* name : {"h.exr", "h.tif", "h.png"}) {
    const ExportReport report = export_heightfield(field, folder.file(name));
    const double tolerance = report.precision > 0 ? 0.51 * report.precision + 1e-4 : 1e-4;
    EXPECT_LE(largest_difference(imported(folder, name), field.height), tolerance) << name;
    EXPECT_EQ(report.width, 33);
    EXPECT_EQ(report.height, 17);
  }
}

TEST(Export, RawComesBackInBothByteOrdersAndRowOrders) {
  const TemporaryFolder folder;
  const Heightfield field = sample_field();
  for (const ByteOrder order : {ByteOrder::little, ByteOrder::big})
    for (const bool flip : {false, true}) {
      const ExportReport report =
          export_heightfield(field, folder.file("h.r16"), {.byte_order = order, .flip = flip});
      const Grid<float> back =
          imported(folder, "h.r16",
                   {{"height", std::vector<double>{report.range.low, report.range.high}},
                    {"byte_order", std::string(order == ByteOrder::little ? "little" : "big")},
                    {"flip", flip},
                    {"raw_width", std::int64_t{33}}});
      EXPECT_LE(largest_difference(back, field.height), 0.51 * report.precision + 1e-4);
    }
}

TEST(Export, NorthIsUpInPictures) {
  const TemporaryFolder folder;
  Heightfield field = field_of(5, 4, 1, {0, 0}, [](DVec2) { return 0; });
  field.height(4, 3) = 7;  // north-east
  field.height(0, 0) = 3;  // south-west
  export_heightfield(field, folder.file("h.exr"));
  const Image image = read_picture(folder.file("h.exr")).image;
  EXPECT_EQ(image.at(4, 0, 0), 7);
  EXPECT_EQ(image.at(0, 3, 0), 3);
}

TEST(Export, ImportReadsAnyChannelAndUndoesTheSrgbCurveWhenAsked) {
  const TemporaryFolder folder;
  Image image(4, 4, {"R", "G", "B"}, 0.25F);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x) image.at(x, y, 1) = 0.5F;
  write_png(folder.file("c.png"), image, {.bits = 8});
  const Value range = std::vector<double>{0, 1000};
  EXPECT_NEAR(imported(folder, "c.png", {{"height", range}})(3, 3), 1000 * 64 / 255.0, 1e-2);
  EXPECT_NEAR(imported(folder, "c.png", {{"height", range}, {"channel", std::string("G")}})(3, 3),
              1000 * 128 / 255.0, 1e-2);
  EXPECT_NEAR(imported(folder, "c.png",
                       {{"height", range},
                        {"channel", std::string("G")},
                        {"transfer", std::string("srgb")}})(3, 3),
              1000 * std::pow((128 / 255.0 + 0.055) / 1.055, 2.4), 1e-1);
  const std::string text = error_text([&] {
    imported(folder, "c.png", {{"channel", std::string("height")}});
  });
  EXPECT_NE(text.find("height"), std::string::npos) << text;
}

TEST(Export, CoarserGroundFromAFinePictureIsItsMean) {
  const TemporaryFolder folder;
  const Heightfield checks = field_of(513, 257, 0.5, {-128, -64}, [](DVec2 p) {
    return std::fmod(std::abs(2 * (p.x + p.y)), 2) < 1 ? 0 : 10;  // alternates by sample
  });
  export_heightfield(checks, folder.file("h.exr"));
  const Grid<float> coarse = imported(folder, "h.exr");
  for (const float h : coarse.values()) ASSERT_NEAR(h, 5, 0.5);
}

TEST(Export, MeshHasTheGroundsExtentAndFacesUp) {
  const Heightfield field = sample_field();
  const TriangleMesh mesh = mesh_of(field);
  EXPECT_EQ(mesh.positions.size(), 33U * 17);
  EXPECT_EQ(mesh.triangles.size(), 2U * 32 * 16);
  EXPECT_EQ(mesh.bounds().low.x, -128);
  EXPECT_EQ(mesh.bounds().high.y, 64);
  double area = 0;
  for (const UVec3& t : mesh.triangles) {
    const Vec3 a = mesh.positions[t.x];
    const Vec3 normal = glm::cross(mesh.positions[t.y] - a, mesh.positions[t.z] - a);
    ASSERT_GT(normal.z, 0);
    area += 0.5 * static_cast<double>(normal.z);
  }
  EXPECT_NEAR(area, 256 * 128, 1e-1);
  for (const Vec3& n : mesh.normals) ASSERT_GT(n.z, 0.5);
}

TEST(Export, MeshFormatsComeBack) {
  const TemporaryFolder folder;
  const Heightfield field = sample_field();
  const TriangleMesh mesh = mesh_of(field);
  for (const char* name : {"h.obj", "h.ply", "h.glb"}) {
    export_heightfield(field, folder.file(name));
    const TriangleMesh back = read_mesh(folder.file(name));
    ASSERT_EQ(back.triangles.size(), mesh.triangles.size()) << name;
    EXPECT_NEAR(back.bounds().low.z, mesh.bounds().low.z, 1e-3) << name;
    EXPECT_NEAR(back.bounds().high.y, mesh.bounds().high.y, 1e-3) << name;
  }
}

TEST(Export, UnrealScalesReproduceTheHeights) {
  const TemporaryFolder folder;
  const Heightfield field = sample_field(127, 127);
  const EnginePreset unreal = find_engine("unreal");
  const ExportReport report = export_for_engine(field, folder.file("h.r16"), unreal);
  std::map<std::string, double> settings;
  for (const auto& [name, text] : report.settings) settings[name] = std::stod(text);
  EXPECT_EQ(settings.at("Scale X"), 800);
  const Image image = read_raw16(folder.file("h.r16"));
  for (int k = 0; k < 127; k += 9) {
    const double v = std::round(65535.0 * image.at(k, 126 - k, 0));
    const double cm = settings.at("Location Z (cm)") + settings.at("Scale Z") * (v - 32768) / 128;
    EXPECT_NEAR(cm / 100, field.height(k, k), report.precision + 0.02);
  }
}

TEST(Export, UnityBeginsInTheSouth) {
  const TemporaryFolder folder;
  const Heightfield field = field_of(33, 33, 2, {0, 0}, [](DVec2 p) { return p.y; });
  const ExportReport report = export_for_engine(field, folder.file("h.raw"), find_engine("unity"));
  std::ifstream file(folder.file("h.raw"), std::ios::binary);
  EXPECT_EQ(file.get(), 0);
  file.seekg(-1, std::ios::end);
  EXPECT_EQ(file.get(), 255);
  EXPECT_EQ(std::filesystem::file_size(folder.file("h.raw")), 2U * 33 * 33);
  const std::pair<std::string, std::string> size{"Terrain Size Y (m)", "64"};
  EXPECT_NE(std::find(report.settings.begin(), report.settings.end(), size), report.settings.end());
}

TEST(Export, EnginesRefuseWhatTheyCannotTake) {
  const EnginePreset unreal = find_engine("unreal");
  EXPECT_EQ(engine_size(unreal, 1025), 1009);
  EXPECT_EQ(engine_size(find_engine("unity"), 1000), 1025);
  EXPECT_EQ(error_text([&] { check_engine_export(unreal, "h.png", 1025, 1025); }, ErrorKind::usage),
            "unreal does not take 1025 x 1025 samples; sides can be 127, 253, 505, 1009, 2017, "
            "4033, 8129");
  EXPECT_EQ(error_text([&] { check_engine_export(unreal, "h.exr", 1009, 1009); }, ErrorKind::usage),
            "unreal takes .png or .r16 files, not 'h.exr'");
  EXPECT_EQ(error_text([] { find_engine("unrael"); }, ErrorKind::usage),
            "unknown engine 'unrael'. Did you mean 'unreal'?");
  EXPECT_EQ(error_text([] { check_export("height.bmp"); }, ErrorKind::usage),
            "'height.bmp' does not say in which format heights are wanted; known: .exr, .tif, "
            ".tiff, .png, .r16, .raw, .obj, .ply, .glb");
}

TEST(Export, LevelGroundAndMaps) {
  const TemporaryFolder folder;
  const Heightfield level = field_of(5, 5, 1, {0, 0}, [](DVec2) { return 7; });
  const ExportReport report = export_heightfield(level, folder.file("h.png"));
  EXPECT_EQ(report.range, (Range{7, 8}));
  const auto paths = export_maps({{"flow", level.height}}, (folder.path() / "maps").string());
  ASSERT_EQ(paths.size(), 1U);
  EXPECT_EQ(channel_grid(read_picture(paths[0]).image), level.height);
}

}  // namespace
}  // namespace wold
