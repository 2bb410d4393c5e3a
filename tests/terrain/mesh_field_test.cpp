#include "terrain/mesh_field.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "base/parallel.hpp"
#include "mesh/editable.hpp"
#include "terrain/mesh_of.hpp"
#include "testing.hpp"

namespace wold {
namespace {

using testing_terrain::error_text;
using testing_terrain::field_of;
using testing_terrain::largest_difference;

struct Mesh {
  std::vector<DVec3> positions;
  std::vector<UVec3> triangles;
};

Mesh mesh_from(const Heightfield& field) {
  const TriangleMesh mesh = mesh_of(field);
  Mesh result{{}, mesh.triangles};
  for (const Vec3& p : mesh.positions) result.positions.emplace_back(p);
  return result;
}

MeshProjection projected(const Mesh& mesh, const ProjectionSettings& settings = {}) {
  Progress progress;
  return {mesh.positions, mesh.triangles, settings, progress};
}

std::size_t displaced(const MeshProjection& ground, Mesh& mesh, const Heightfield& after) {
  return ground.displace(mesh.positions, after);
}

double hills(DVec2 p) {
  return 40 * std::sin(p.x / 17) * std::cos(p.y / 23) + 0.1 * p.x;
}

/// A floor and walls under the rim of a grid of vertices, as a solid for printing has.
void add_floor(Mesh& mesh, int width, int height, double floor) {
  const auto top = static_cast<std::uint32_t>(mesh.positions.size());
  for (std::uint32_t k = 0; k < top; ++k)
    mesh.positions.emplace_back(mesh.positions[k].x, mesh.positions[k].y, floor);
  const auto w = static_cast<std::uint32_t>(width);
  const auto corner = top + w * static_cast<std::uint32_t>(height - 1);
  mesh.triangles.emplace_back(top, corner, top + w - 1);
  mesh.triangles.emplace_back(top + w - 1, corner, corner + w - 1);
  for (std::uint32_t i = 0; i + 1 < w; ++i) {
    mesh.triangles.emplace_back(i, top + i, i + 1);
    mesh.triangles.emplace_back(i + 1, top + i, top + i + 1);
  }
}

TEST(MeshField, AGridOfVerticesGivesItsHeightsExactly) {
  for (const double cell : {4.0, 0.3, 7.31}) {
    const Heightfield field = field_of(37, 23, cell, {-50, 1000}, hills);
    const MeshProjection ground = projected(mesh_from(field));
    EXPECT_EQ(ground.field().height.width(), 37);
    EXPECT_EQ(ground.field().height.height(), 23);
    EXPECT_NEAR(ground.field().cell, cell, 1e-5 * cell);
    EXPECT_LT(largest_difference(ground.field().height, field.height), 1e-4F) << cell;
    for (const auto covered : ground.covered().values()) EXPECT_EQ(covered, 1);
    for (const auto moves : ground.on_surface()) EXPECT_EQ(moves, 1);
  }
}

TEST(MeshField, DisplacementsLandOnTheirVerticesAndNothingBeneathMoves) {
  const int width = 20;
  const int height = 12;
  const Heightfield field = field_of(width, height, 2, {0, 0}, [](DVec2 p) { return 50 + p.x; });
  Mesh mesh = mesh_from(field);
  add_floor(mesh, width, height, -10);
  const Mesh before = mesh;
  const MeshProjection ground = projected(mesh);
  ASSERT_TRUE(ground.field().height.same_shape(field.height));
  Heightfield after = ground.field();
  after.height(3, 5) -= 7;
  after.height(0, 0) += 2;
  EXPECT_EQ(displaced(ground, mesh, after), field.height.size());
  for (std::size_t k = 0; k < mesh.positions.size(); ++k) {
    const double moved = k == 3 + 5 * 20 ? -7 : k == 0 ? 2 : 0;
    EXPECT_NEAR(mesh.positions[k].z - before.positions[k].z, moved, 1e-5) << k;
  }
}

TEST(MeshField, TheHighestSurfaceCounts) {
  // A sloping plane, and a table over a part of it.
  Mesh mesh{{{0, 0, 0},
             {10, 0, 10},
             {10, 10, 10},
             {0, 10, 0},  //
             {2, 2, 20},
             {5, 2, 20},
             {5, 5, 20},
             {2, 5, 20},
             {3, 3, 3}},
            {{0, 1, 2}, {0, 2, 3}, {4, 6, 5}, {4, 7, 6}, {8, 8, 8}}};
  const MeshProjection ground = projected(mesh, {.cell = 1});
  ASSERT_EQ(ground.field().height.width(), 11);
  for (int j = 0; j < 11; ++j)
    for (int i = 0; i < 11; ++i) {
      const bool table = i >= 2 && i <= 5 && j >= 2 && j <= 5;
      EXPECT_NEAR(ground.field().height(i, j), table ? 20 : i, 1e-5) << i << " " << j;
    }
  const std::vector<std::uint8_t> expected{1, 1, 1, 1, 1, 1, 1, 1, 0};  // the last is under it
  EXPECT_TRUE(std::equal(expected.begin(), expected.end(), ground.on_surface().begin()));
}

TEST(MeshField, VerticesALittleBeneathMoveAlong) {
  Mesh mesh{{{0, 0, 0}, {10, 0, 0}, {0, 10, 0}, {1, 1, -0.05}, {2, 1, -0.05}, {1, 2, -0.05}},
            {{0, 1, 2}, {3, 4, 5}}};
  EXPECT_EQ(projected(mesh, {.cell = 1}).on_surface()[3], 1);
  EXPECT_EQ(projected(mesh, {.cell = 1, .tolerance = 0.01}).on_surface()[3], 0);
}

TEST(MeshField, WhatIsNotCoveredGoesOnSmoothly) {
  // A slope with a hole, and a corner cut off: in the hole Laplace's equation gives the slope back.
  const int n = 65;
  const Heightfield field = field_of(n, n, 1, {0, 0}, [](DVec2 p) { return 3 * p.x - p.y; });
  Mesh mesh = mesh_from(field);
  std::vector<UVec3> kept;
  for (const UVec3& t : mesh.triangles) {
    const DVec3 middle = (mesh.positions[t.x] + mesh.positions[t.y] + mesh.positions[t.z]) / 3.0;
    const bool hole = glm::distance(DVec2(middle), DVec2(30, 30)) < 12;
    if (!hole && middle.x + middle.y < 100) kept.push_back(t);
  }
  mesh.triangles = kept;
  const MeshProjection ground = projected(mesh);
  int filled = 0;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const float h = ground.field().height(i, j);
      ASSERT_TRUE(std::isfinite(h));
      ASSERT_GT(h, -65);
      ASSERT_LT(h, 193);
      if (ground.covered()(i, j) != 0 || i + j >= 100) continue;
      ++filled;
      EXPECT_NEAR(h, field.height(i, j), 1.5) << i << " " << j;
    }
  EXPECT_GT(filled, 300);
  EXPECT_EQ(ground.covered()(60, 60), 0);
  // Nowhere a step as high as from a hole to the ground.
  for (int j = 0; j + 1 < n; ++j)
    for (int i = 0; i + 1 < n; ++i)
      EXPECT_LT(std::abs(ground.field().height(i + 1, j) - ground.field().height(i, j)), 8);
}

TEST(MeshField, LargeTrianglesAreTheirPlane) {
  const Mesh mesh{{{0, 0, 5}, {1000, 0, 25}, {1000, 700, 30}, {0, 700, 10}},
                  {{0, 1, 2}, {0, 2, 3}}};
  const MeshProjection ground = projected(mesh, {.resolution = 601});
  EXPECT_EQ(ground.field().height.width(), 601);
  EXPECT_EQ(ground.field().height.height(), 421);
  for (int j = 0; j < 421; ++j)
    for (int i = 0; i < 601; ++i) {
      const DVec2 p = ground.field().cell * DVec2(i, j);
      ASSERT_NEAR(ground.field().height(i, j), 5 + p.x / 50 + p.y * 5 / 700, 1e-4) << i << " " << j;
    }
}

TEST(MeshField, TheScaleIsTheMeshsUnit) {
  const Heightfield field = field_of(9, 9, 0.01, {0, 0}, [](DVec2 p) { return 3 * p.x * p.y; });
  Mesh mesh = mesh_from(field);
  const Mesh before = mesh;
  const MeshProjection ground = projected(mesh, {.scale = 100});
  EXPECT_NEAR(ground.field().cell, 1, 1e-5);
  EXPECT_NEAR(ground.field().height(8, 8), 100 * field.height(8, 8), 1e-5);
  Heightfield after = ground.field();
  after.height(4, 4) += 1;
  displaced(ground, mesh, after);
  EXPECT_NEAR(mesh.positions[40].z - before.positions[40].z, 0.01, 1e-6);
}

TEST(MeshField, ThreadsDoNotMatter) {
  const Heightfield field = field_of(90, 80, 3, {0, 0}, hills);
  Mesh mesh = mesh_from(field);
  for (DVec3& p : mesh.positions) {  // no grid any more, and folds
    p.x += 5 * std::sin(p.y);
    p.y += 4 * std::cos(p.x / 3);
  }
  const auto result = [&](int threads) {
    const ThreadLimit limit(threads);
    const MeshProjection ground = projected(mesh);
    return std::pair(ground.field().height, std::vector<std::uint8_t>(ground.on_surface().begin(),
                                                                      ground.on_surface().end()));
  };
  const auto one = result(1);
  EXPECT_EQ(one, result(2));
  EXPECT_EQ(one, result(4));
}

TEST(MeshField, QuadsOfAFileAreErodedInPlace) {
  std::string text = "g field\n";
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 5; ++i) text += "v " + std::to_string(i) + " " + std::to_string(j) + " 1\n";
  const std::string faces =
      "f 1 2 7 6\nf 2 3 8 7\nf 3 4 9 8\nf 4 5 10 9\nf 6 7 12 11\nf 7 8 13 12\n"
      "f 8 9 14 13\nf 9 10 15 14\nf 11 12 17 16\nf 12 13 18 17 # last\n"
      "f 13 14 19 18\nf 14 15 20 19\n";
  EditableMesh mesh = EditableMesh::parse(text + faces, "field.obj");
  Progress progress;
  const MeshProjection ground(mesh.positions(), mesh.triangles(), {}, progress);
  Heightfield after = ground.field();
  after.height(2, 1) = 0.25F;
  EXPECT_EQ(ground.displace(mesh.positions(), after), 20U);
  const auto at = text.find("v 2 1 1\n");
  EXPECT_EQ(mesh.bytes(), text.substr(0, at) + "v 2 1 0.25\n" + text.substr(at + 8) + faces);
}

TEST(MeshField, ErrorsAreClear) {
  const auto message = [](const Mesh& mesh, const ProjectionSettings& settings = {},
                          ErrorKind kind = ErrorKind::input) {
    return error_text([&] { projected(mesh, settings); }, kind);
  };
  const auto contains = [](const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<UVec3> one{{0, 1, 2}};
  const Mesh good{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, one};
  contains(message({good.positions, {}}), "it has no faces");
  contains(message({{{0, 0, 0}, {1, 0, 0}, {0, 1, nan}}, one}), "vertex 2 (counted from 0)");
  contains(message({{{0, 0, 0}, {1, 0, 0}, {1, 0, 1}}, one}), "measures 1 m x 0 m");
  contains(message({{{0, 0, 0}, {1, 1, 0}, {1, 1, 1}}, one}), "all its faces stand upright");
  contains(message({{{2, 2, 0}, {2, 2, 0}, {2, 2, 0}}, one}), "measures 0 m x 0 m");
  contains(message(good, {.cell = -1}), "'cell' is -1");
  contains(message(good, {.resolution = 1}), "'resolution' is 1; 2 or more");
  contains(message(good, {.scale = 0}), "'scale' is 0; a number above 0");
  contains(message(good, {.tolerance = nan}), "'tolerance' is nan");
  contains(message(good, {.cell = 1e-9}, ErrorKind::limit), "Choose a larger cell");
  Progress cancelled;
  cancelled.cancel();
  EXPECT_NE(error_text([&] { MeshProjection(good.positions, good.triangles, {}, cancelled); },
                       ErrorKind::cancelled),
            "no error");
  const MeshProjection ground = projected(good);
  Mesh moved = good;
  Heightfield after = ground.field();
  after.height(0, 0) = std::numeric_limits<float>::infinity();
  contains(error_text([&] { displaced(ground, moved, after); }), "not finite");
  EXPECT_EQ(moved.positions, good.positions);
  after.height = Grid<float>(3, 3);
  contains(error_text([&] { displaced(ground, moved, after); }, ErrorKind::internal),
           "not what was");
}

}  // namespace
}  // namespace wold
