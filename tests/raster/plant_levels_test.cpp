#include "raster/plant_levels.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/parallel.hpp"
#include "plants/plant.hpp"
#include "raster/plant_mesh.hpp"
#include "raster/plant_openness.hpp"
#include "raster/plant_shape.hpp"

namespace wold {
namespace {

Material material_of(const std::string& name, bool leaf) {
  Material m;
  m.name = name;
  if (leaf) m.transmission = Vec3(0.05F, 0.1F, 0.02F);
  return m;
}

struct Grown {
  Model model;
  std::vector<SurfaceMaterial> materials;
};

Grown grown(const std::string& name) {
  Progress progress;
  const Plant plant = load_plant(std::string(WOLD_SOURCE_DIR) + "/plants/" + name + ".lsys");
  Grown g;
  g.model.mesh = grow(plant, {.seed = 3, .height = 0, .detail = 0.6F}, progress);
  for (const MeshPart& part : g.model.mesh.parts) {
    const PlantMaterial* m = plant.find_material(part.material);
    const bool leaf = m != nullptr && m->transmittance != Vec3(0);
    g.model.part_materials.push_back(static_cast<std::uint32_t>(g.materials.size()));
    g.materials.emplace_back(material_of(part.material, leaf));
  }
  return g;
}

/// Area of the parts of leaves, and of the rest.
Vec2 areas(const TriangleMesh& mesh, const std::vector<SurfaceMaterial>& materials,
           const std::vector<std::uint32_t>& of_part) {
  DVec2 sum(0);
  for (std::size_t p = 0; p < mesh.parts.size(); ++p) {
    const bool leaf = materials[of_part[p]].settings().transmission != Vec3(0);
    const MeshPart& part = mesh.parts[p];
    for (std::uint32_t t = 0; t < part.triangle_count; ++t)
      sum[leaf ? 0 : 1] += static_cast<double>(triangle_area(mesh, part.first_triangle + t));
  }
  return sum;
}

/// A tube along a half circle.
TriangleMesh bent_tube(float radius, float bend, int sides, int rings) {
  TriangleMesh mesh;
  for (int j = 0; j <= rings; ++j) {
    const float a = pi * static_cast<float>(j) / static_cast<float>(rings);
    const Vec3 out(std::cos(a), 0, std::sin(a));
    for (int k = 0; k < sides; ++k) {
      const float b = 2 * pi * static_cast<float>(k) / static_cast<float>(sides);
      mesh.positions.push_back(bend * out +
                               radius * (std::cos(b) * out + std::sin(b) * Vec3(0, 1, 0)));
    }
  }
  const auto n = static_cast<std::uint32_t>(sides);
  for (std::uint32_t j = 0; j < static_cast<std::uint32_t>(rings); ++j)
    for (std::uint32_t k = 0; k < n; ++k) {
      const std::uint32_t a = j * n + k;
      const std::uint32_t b = j * n + (k + 1) % n;
      mesh.triangles.emplace_back(a, b, b + n);
      mesh.triangles.emplace_back(a, b + n, a + n);
    }
  mesh.parts.push_back({"bark", 0, static_cast<std::uint32_t>(mesh.triangles.size())});
  return mesh;
}

TEST(PlantShape, EveryTriangleIsInOneElement) {
  const Grown g = grown("fern");
  const PlantElements e = plant_elements(g.model.mesh);
  std::vector<int> seen(g.model.mesh.triangles.size(), 0);
  for (const PlantElement& element : e.list)
    for (const std::uint32_t t : e.of(element)) ++seen[t];
  for (const int n : seen) EXPECT_EQ(n, 1);
  EXPECT_GT(e.list.size(), 100U);
}

TEST(PlantShape, CurveOfABentTubeIsItsMiddleLine) {
  const TriangleMesh mesh = bent_tube(0.05F, 1, 12, 64);
  const PlantElements e = plant_elements(mesh);
  ASSERT_EQ(e.list.size(), 1U);
  const PlantCurve curve = plant_curve(mesh, e.of(e.list.front()), 8);
  ASSERT_EQ(curve.centre.size(), 9U);
  for (std::size_t k = 1; k < 8; ++k) {
    EXPECT_NEAR(glm::length(curve.centre[k]), 1, 0.02F);
    EXPECT_NEAR(curve.centre[k].y, 0, 0.02F);
    EXPECT_NEAR(curve.width[k], 2 * pi * 0.05F, 0.15F * 2 * pi * 0.05F);
  }
}

TEST(PlantOpenness, IsThatOfAnEmptySpaceWhereNothingGrows) {
  // One tiny leaf in a corner and one in the other: nearly all light reaches the middle.
  TriangleMesh mesh;
  for (const Vec3 at : {Vec3(0), Vec3(4)})
    for (const Vec3 off : {Vec3(0), Vec3(0.01F, 0, 0), Vec3(0, 0.01F, 0)})
      mesh.positions.push_back(at + off);
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  mesh.parts = {{"leaf", 0, 2}};
  const Vec4 light = PlantOpenness(mesh, {true}).at(Vec3(2));
  EXPECT_NEAR(light.w, 1, 0.01F);
  EXPECT_NEAR(glm::length(Vec3(light)), 0, 0.15F);
}

TEST(PlantOpenness, ExtinctionIsThatAmongTheLeaves) {
  // A box of 2 m full of leaves in all cells, and one leaf far off: 1000 of 0.005 m² in 8 m³.
  TriangleMesh mesh;
  const auto add = [&mesh](Vec3 at) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const Vec3 off : {Vec3(0), Vec3(0.1F, 0, 0), Vec3(0, 0.1F, 0)})
      mesh.positions.push_back(at + off);
    mesh.triangles.emplace_back(first, first + 1, first + 2);
  };
  for (int k = 0; k < 1000; ++k)
    add(0.2F * Vec3(k % 10, k / 10 % 10, k / 100) + Vec3(0.05F, 0.05F, 0.1F));
  add({7.8F, 1, 1});
  mesh.parts = {{"leaf", 0, 1001}};
  const PlantOpenness openness(mesh, {true});
  EXPECT_NEAR(openness.mean_extinction(0), 0.5F * 0.9F * 5 / 8, 0.06F);
  // Of the eight leaves in a cell one does not shade itself.
  EXPECT_NEAR(openness.mean_extinction(0.005F), 7.0F / 8 * openness.mean_extinction(0), 0.01F);
  EXPECT_EQ(openness.mean_extinction(1), 0);
  TriangleMesh none;
  none.positions = {Vec3(0), Vec3(1, 0, 0)};
  EXPECT_EQ(PlantOpenness(none, {true}).mean_extinction(0), 0);
}

TEST(PlantOpenness, IsLessWithinACrownAndMostTowardsItsOutside) {
  const Grown g = grown("oak");
  std::vector<bool> sheet;
  for (const std::uint32_t m : g.model.part_materials)
    sheet.push_back(g.materials[m].settings().transmission != Vec3(0));
  const PlantOpenness openness(g.model.mesh, sheet);
  const auto [low, high] = g.model.mesh.bounds();
  const Vec3 middle = 0.5F * (low + high);
  const Vec3 half = 0.5F * (high - low);
  const Vec4 inside = openness.at(middle);
  const Vec4 outside = openness.at(middle + Vec3(0.95F * half.x, 0, 0));
  EXPECT_LT(inside.w, 0.8F * outside.w);
  EXPECT_GT(outside.x, 0);
}

TEST(PlantLevels, GrowthMakesUpForWhatGoes) {
  for (const float share : {1.0F, 0.9F, 0.7F, 0.3F, 0.01F}) {
    double leaves = 0;
    double strips = 0;
    constexpr int count = 20000;
    for (int k = 0; k < count; ++k) {
      const float rank = (static_cast<float>(k) + 0.5F) / count;
      const double f =
          std::clamp((share * (1 + plant_fade) - rank) / (plant_fade * share), 0.0F, 1.0F);
      leaves += f * f / count;
      strips += f / count;
    }
    EXPECT_NEAR(leaves * static_cast<double>(leaf_growth(share)), 1, 1e-3);
    EXPECT_NEAR(strips * static_cast<double>(strip_growth(share)), 1, 1e-3);
  }
}

class PlantLevelsOf : public testing::TestWithParam<const char*> {};

TEST_P(PlantLevelsOf, KeepTheArea) {
  const Grown g = grown(GetParam());
  const PlantLevels levels = plant_levels(g.model, g.materials);
  const Vec2 full = areas(g.model.mesh, g.materials, g.model.part_materials);
  const Vec2 fine = areas(plant_mesh_at(levels, true, 1), g.materials, levels.materials);
  EXPECT_NEAR(fine.x, full.x, 1e-3F * full.x);
  EXPECT_NEAR(fine.y, full.y, 1e-3F * full.y);
  EXPECT_NEAR(areas(plant_mesh_at(levels, true, 0.6F), g.materials, levels.materials).x, full.x,
              0.06F * full.x);
  const Vec2 start = areas(plant_mesh_at(levels, false, 1), g.materials, levels.materials);
  EXPECT_NEAR(start.x, full.x, 0.03F * full.x);
  for (const float share : {0.7F, 0.4F, 0.2F, 0.1F}) {
    const Vec2 coarse = areas(plant_mesh_at(levels, false, share), g.materials, levels.materials);
    EXPECT_NEAR(coarse.x, full.x, 0.06F * full.x) << share;
    EXPECT_NEAR(coarse.y, start.y, 0.08F * start.y) << share;
  }
}

TEST_P(PlantLevelsOf, KeepTheBounds) {
  const Grown g = grown(GetParam());
  const PlantLevels levels = plant_levels(g.model, g.materials);
  const auto full = g.model.mesh.bounds();
  const float margin = 0.08F * glm::length(full.high - full.low);
  for (const float share : {1.0F, 0.5F, 0.1F}) {
    TriangleMesh mesh = plant_mesh_at(levels, false, share);
    std::vector<Vec3> used;
    for (const UVec3& t : mesh.triangles)
      for (int k = 0; k < 3; ++k) used.push_back(mesh.positions[t[k]]);
    mesh.positions = used;
    const auto bounds = mesh.bounds();
    for (int k = 0; k < 3; ++k) {
      EXPECT_GT(bounds.low[k], full.low[k] - margin) << share;
      EXPECT_LT(bounds.high[k], full.high[k] + margin) << share;
      EXPECT_LT(bounds.low[k], full.low[k] + 2 * margin) << share;
      EXPECT_GT(bounds.high[k], full.high[k] - 2 * margin) << share;
    }
  }
}

TEST_P(PlantLevelsOf, HaveFewerTrianglesEachTime) {
  const Grown g = grown(GetParam());
  const PlantLevels levels = plant_levels(g.model, g.materials);
  EXPECT_EQ(levels.fine.front().index_count, 3 * g.model.mesh.triangles.size());
  EXPECT_LE(levels.coarse.front().index_count, levels.fine.front().index_count);
  for (std::size_t k = 1; k < levels.coarse.size(); ++k)
    EXPECT_LE(levels.coarse[k].index_count, levels.coarse[k - 1].index_count);
  EXPECT_LT(levels.coarse.back().index_count, 3U * 3000U);
}

INSTANTIATE_TEST_SUITE_P(Plants, PlantLevelsOf,
                         testing::Values("birch", "spruce", "oak", "hazel", "fern", "grass"));

TEST(PlantLevels, AreTheSameForAnyNumberOfThreads) {
  World world{Ground({Grid<float>(2, 2, 0.0F), DVec2(0), 100}, {}, {}, 1), {}, {}, {}, Sky()};
  for (const char* name : {"fern", "grass", "hazel"}) {
    Grown g = grown(name);
    for (std::uint32_t& m : g.model.part_materials)
      m += static_cast<std::uint32_t>(world.materials.size());
    world.models.push_back(std::move(g.model));
    world.materials.insert(world.materials.end(), g.materials.begin(), g.materials.end());
  }
  std::vector<std::vector<PlantLevels>> results;
  for (const int threads : {1, 2, 4}) {
    const ThreadLimit limit(threads);
    Progress progress;
    results.push_back(plant_levels(world, progress));
  }
  for (std::size_t r = 1; r < results.size(); ++r)
    for (std::size_t k = 0; k < results[r].size(); ++k) {
      const auto bytes = [](const PlantLevels& l) { return std::as_bytes(std::span(l.vertices)); };
      const auto a = bytes(results[0][k]);
      const auto b = bytes(results[r][k]);
      EXPECT_TRUE(std::equal(a.begin(), a.end(), b.begin(), b.end()));
      EXPECT_EQ(results[0][k].indices, results[r][k].indices);
    }
}

}  // namespace
}  // namespace wold
