// The species in plants/: what a user gets.

#include "plants/plant.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

namespace wold {
namespace {

TriangleMesh grown(const std::string& name, const GrowSettings& settings) {
  Progress progress;
  return grow(load_plant(std::string(WOLD_SOURCE_DIR "/plants/") + name + ".lsys"), settings,
              progress);
}

bool same(const TriangleMesh& a, const TriangleMesh& b) {
  return a.positions == b.positions && a.normals == b.normals && a.uvs == b.uvs &&
         a.triangles == b.triangles;
}

struct Species {
  const char* name;
  float height;  ///< m, of the file
  float width;   ///< m, greatest width of its individuals, least and most
  float most_width;
  std::size_t triangles;  ///< least and most
  std::size_t most_triangles;
  std::set<std::string> materials;
};

void PrintTo(const Species& s, std::ostream* out) {
  *out << s.name;
}

class SpeciesTest : public testing::TestWithParam<Species> {};

TEST_P(SpeciesTest, GrowsWithinItsBudget) {
  const Species& s = GetParam();
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const TriangleMesh mesh = grown(s.name, {.seed = seed});
    const auto b = mesh.bounds();
    EXPECT_EQ(b.high.z, s.height);
    EXPECT_GE(b.low.z, -0.12F * s.height - 0.1F) << "seed " << seed;
    const float width = std::max(b.high.x - b.low.x, b.high.y - b.low.y);
    EXPECT_GE(width, s.width) << "seed " << seed;
    EXPECT_LE(width, s.most_width) << "seed " << seed;
    EXPECT_GE(mesh.triangles.size(), s.triangles) << "seed " << seed;
    EXPECT_LE(mesh.triangles.size(), s.most_triangles) << "seed " << seed;
    ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
    ASSERT_EQ(mesh.uvs.size(), mesh.positions.size());
    const auto bad = [](const Vec3& v) { return !std::isfinite(v.x + v.y + v.z); };
    const auto not_unit = [](const Vec3& n) { return !(std::abs(glm::length(n) - 1) < 1e-3F); };
    EXPECT_EQ(std::count_if(mesh.positions.begin(), mesh.positions.end(), bad), 0);
    EXPECT_EQ(std::count_if(mesh.normals.begin(), mesh.normals.end(), not_unit), 0);
    std::set<std::string> materials;
    for (const MeshPart& part : mesh.parts) materials.insert(part.material);
    EXPECT_EQ(materials, s.materials);
  }
}

TEST_P(SpeciesTest, DescribesItsMaterials) {
  const Plant plant =
      load_plant(std::string(WOLD_SOURCE_DIR "/plants/") + GetParam().name + ".lsys");
  for (const std::string& name : GetParam().materials) {
    const PlantMaterial* m = plant.find_material(name);
    ASSERT_NE(m, nullptr) << name;
    for (int k = 0; k < 3; ++k) EXPECT_LE(m->reflectance[k] + m->transmittance[k], 0.9F);
  }
}

TEST_P(SpeciesTest, IsTheSameAgainAndDiffersBySeed) {
  const TriangleMesh a = grown(GetParam().name, {.seed = 5});
  EXPECT_TRUE(same(a, grown(GetParam().name, {.seed = 5})));
  EXPECT_FALSE(same(a, grown(GetParam().name, {.seed = 6})));
}

INSTANTIATE_TEST_SUITE_P(
    Plants, SpeciesTest,
    testing::Values(
        Species{"birch", 14, 3.5F, 8, 100'000, 300'000, {"bark", "twig", "leaf"}},
        Species{"spruce", 17, 4, 7, 150'000, 360'000, {"bark", "twig", "needle"}},
        Species{"pine", 18, 4, 10, 120'000, 360'000, {"bark", "bark_upper", "twig", "needle"}},
        Species{"oak", 13, 9, 22, 150'000, 360'000, {"bark", "leaf"}},
        Species{"hazel", 3.2F, 2.5F, 7, 40'000, 180'000, {"bark", "leaf"}},
        Species{"fern", 0.7F, 0.6F, 2.2F, 2'000, 8'000, {"stem", "leaf"}},
        Species{"grass", 0.42F, 0.5F, 1.6F, 500, 3'000, {"grass"}},
        Species{"daisy", 0.48F, 0.15F, 0.8F, 500, 5'000, {"stem", "leaf", "petal", "flower_head"}},
        Species{"bilberry", 0.32F, 0.3F, 1, 2'000, 15'000, {"stem", "leaf", "berry"}}),
    [](const auto& each) { return std::string(each.param.name); });

TEST(Plants, AllFilesGrow) {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(WOLD_SOURCE_DIR "/plants")) {
    if (entry.path().extension() != ".lsys") continue;
    ++files;
    Progress progress;
    const Plant plant = load_plant(entry.path().string());
    EXPECT_EQ(plant.name, entry.path().stem().string());
    const TriangleMesh mesh = grow(plant, {}, progress);
    EXPECT_GT(mesh.triangles.size(), 10U) << plant.name;
    EXPECT_EQ(mesh.bounds().high.z, plant.height) << plant.name;
  }
  EXPECT_GE(files, 15);
}

TEST(Plants, HeightIsExact) {
  for (const float height : {0.37F, 6.0F, 21.3F})
    EXPECT_EQ(grown("hazel", {.seed = 9, .height = height}).bounds().high.z, height);
}

TEST(Plants, DetailTradesTrianglesForTheSameCover) {
  const auto leaf_area = [](const TriangleMesh& mesh) {
    double area = 0;
    for (const MeshPart& part : mesh.parts) {
      if (part.material != "leaf") continue;
      for (std::uint32_t k = 0; k < part.triangle_count; ++k) {
        const UVec3 t = mesh.triangles[part.first_triangle + k];
        area += 0.5 * glm::length(glm::cross(mesh.positions[t.y] - mesh.positions[t.x],
                                             mesh.positions[t.z] - mesh.positions[t.x]));
      }
    }
    return area;
  };
  const TriangleMesh full = grown("hazel", {.seed = 1});
  const TriangleMesh coarse = grown("hazel", {.seed = 1, .detail = 0.25F});
  EXPECT_LT(coarse.triangles.size(), full.triangles.size() / 2);
  EXPECT_NEAR(leaf_area(coarse) / leaf_area(full), 1, 0.1);
}

TEST(Plants, FewerIterationsGiveAYoungerPlant) {
  EXPECT_LT(grown("honda", {.iterations = 5}).triangles.size(),
            grown("honda", {}).triangles.size() / 2);
}

// The leaf family is one flat polygon that mirrors itself.
TEST(Plants, TheLeafIsFlatAndSymmetric) {
  const TriangleMesh leaf = grown("leaf_family", {});
  const auto b = leaf.bounds();
  EXPECT_NEAR(b.low.y, 0, 1e-6);
  EXPECT_NEAR(b.high.y, 0, 1e-6);
  EXPECT_NEAR(b.low.x, -b.high.x, 1e-5);
}

}  // namespace
}  // namespace wold
