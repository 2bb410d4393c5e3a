#include "plants/geometry.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <tuple>

#include "plants/branch_mesh.hpp"
#include "plants/plant.hpp"
#include "plants/polygon.hpp"
#include "plants/skeleton.hpp"

namespace wold {
namespace {

using Node = Skeleton::Node;

double volume(const TriangleMesh& mesh) {
  double sum = 0;
  for (const UVec3& t : mesh.triangles)
    sum += glm::dot(DVec3(mesh.positions[t.x]),
                    glm::cross(DVec3(mesh.positions[t.y]), DVec3(mesh.positions[t.z])));
  return sum / 6;
}

/// Every edge, by the positions of its ends, is used once in each direction.
void expect_watertight(const TriangleMesh& mesh) {
  using Key = std::tuple<float, float, float>;
  const auto key = [&](std::uint32_t v) {
    const Vec3 p = mesh.positions[v];
    return Key(p.x, p.y, p.z);
  };
  std::map<std::pair<Key, Key>, int> edges;
  for (const UVec3& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) ++edges[{key(t[k]), key(t[(k + 1) % 3])}];
  for (const auto& [edge, uses] : edges) {
    const auto back = edges.find({edge.second, edge.first});
    ASSERT_TRUE(back != edges.end() && back->second == uses);
  }
}

void expect_sound(const TriangleMesh& mesh) {
  ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
  ASSERT_EQ(mesh.uvs.size(), mesh.positions.size());
  for (const Vec3& n : mesh.normals) ASSERT_NEAR(glm::length(n), 1, 1e-4);
  for (const Vec3& p : mesh.positions)
    ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
  for (const Vec2& p : mesh.uvs) ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y));
  for (const UVec3& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) ASSERT_LT(t[k], mesh.positions.size());
  std::uint32_t next = 0;
  for (const MeshPart& part : mesh.parts) {
    ASSERT_EQ(part.first_triangle, next);
    next += part.triangle_count;
  }
  ASSERT_EQ(next, mesh.triangles.size());
}

// A prism of n sides has the volume (n/2) sin(2π/n) r² l.
TEST(BranchMesh, AStraightBranchIsAPrism) {
  TriangleMesh mesh;
  add_branch(mesh, {{Vec3(0, 0, 0), 1}, {Vec3(0, 0, 2), 1}, {Vec3(0, 0, 10), 1}}, {.sides = 12});
  expect_watertight(mesh);
  const double base = 6 * std::sin(pi_d / 6);
  EXPECT_NEAR(volume(mesh), base * (10 + 0.6 / 3), 1e-4);
  EXPECT_EQ(mesh.triangles.size(), 12U * 4U);
  TriangleMesh cone;
  add_branch(cone, {{Vec3(0), 1}, {Vec3(0, 0, 9), 0}}, {.sides = 12, .pointed = true});
  expect_watertight(cone);
  EXPECT_NEAR(volume(cone), base * 3, 1e-4);
}

TEST(BranchMesh, ACurvedBranchIsClosedAndSmooth) {
  std::vector<Node> nodes;
  for (int k = 0; k <= 20; ++k) {
    const float a = 0.3F * static_cast<float>(k);
    nodes.push_back(
        {Vec3(3 * std::cos(a), 3 * std::sin(a), a), 0.5F - 0.02F * static_cast<float>(k)});
  }
  TriangleMesh mesh;
  add_branch(mesh, nodes, {.tolerance = 0.01F, .sides = 9, .flare = 0.5F, .sink = 1, .seed = 3});
  expect_watertight(mesh);
  EXPECT_GT(volume(mesh), 0);
  mesh.parts = {{"bark", 0, static_cast<std::uint32_t>(mesh.triangles.size())}};
  expect_sound(mesh);
  // The seam of neighbouring rings does not turn: triangles of a side stay near each other.
  for (const UVec3& t : mesh.triangles)
    EXPECT_LT(glm::distance(mesh.positions[t.x], mesh.positions[t.y]), 2.5F);
}

TEST(Polygon, TriangulatesWithTheRightArea) {
  // An L of area 3, tilted.
  const auto tilt = [](float x, float y) { return Vec3(x, 0.6F * y, 0.8F * y); };
  const std::vector<Vec3> shape{tilt(0, 0), tilt(2, 0), tilt(2, 1),
                                tilt(1, 1), tilt(1, 2), tilt(0, 2)};
  const auto triangles = triangulate(shape);
  EXPECT_EQ(triangles.size(), 4U);
  float area = 0;
  for (const UVec3& t : triangles) {
    const Vec3 normal = glm::cross(shape[t.y] - shape[t.x], shape[t.z] - shape[t.x]);
    EXPECT_GT(glm::dot(normal, polygon_normal(shape)), 0);
    area += 0.5F * glm::length(normal);
  }
  EXPECT_NEAR(area, 3, 1e-5);
  EXPECT_TRUE(triangulate(std::vector<Vec3>{Vec3(0), Vec3(1), Vec3(2)}).empty());
}

TEST(Skeleton, AnAxisGoesOnThroughAFork) {
  Skeleton s;
  s.axes.push_back({-1, 0, 0, {{Vec3(0), 1}, {Vec3(0, 0, 1), 1}}});
  s.axes.push_back({0, 1, 0, {{Vec3(0, 0, 1), 0.7F}, {Vec3(1, 0, 1), 0.7F}}});
  s.axes.push_back({0, 1, 0, {{Vec3(0, 0, 1), 0.7F}, {Vec3(0.2F, 0, 2), 0.7F}}});
  s.axes.push_back({2, 1, 0, {{Vec3(0.2F, 0, 2), 0.5F}, {Vec3(0.2F, 0, 3), 0.5F}}});
  continue_axes(s, true);
  ASSERT_EQ(s.axes.size(), 2U);
  EXPECT_EQ(s.axes[0].nodes.size(), 4U);
  EXPECT_EQ(s.axes[0].nodes.back().position, Vec3(0.2F, 0, 3));
  EXPECT_EQ(s.axes[1].parent, 0);
  EXPECT_EQ(s.axes[1].parent_node, 1);
}

TEST(Skeleton, RadiiFollowDaVinci) {
  Skeleton s;
  s.axes.push_back({-1, 0, 0, {{Vec3(0), 0}, {Vec3(0, 0, 1), 0}, {Vec3(0, 0, 2), 0}}});
  for (int k = 0; k < 8; ++k)
    s.axes.push_back({0, 1, 0, {{Vec3(0, 0, 1), 0}, {Vec3(1, static_cast<float>(k), 1), 0}}});
  set_radii(s, 0.01F, 0.05F);
  EXPECT_NEAR(s.axes[0].nodes[0].radius, 0.05F, 1e-5);
  EXPECT_NEAR(s.axes[0].nodes[2].radius, 0.01F, 1e-5);
  // Σ r^e over what leaves the fork is r^e below it, less the wood between.
  const auto& trunk = s.axes[0].nodes;
  EXPECT_GT(trunk[0].radius, trunk[1].radius);
  EXPECT_GT(trunk[1].radius, trunk[2].radius);
  for (const auto& axis : s.axes)
    for (const Node& n : axis.nodes) EXPECT_GE(n.radius, 0.01F - 1e-6F);
}

TEST(Organ, MeshesAreSound) {
  for (const OrganShape shape : {OrganShape::leaf, OrganShape::shoot, OrganShape::disc}) {
    for (const int segments : {1, 2, 5}) {
      Organ o;
      o.shape = shape;
      o.segments = segments;
      o.fold = 20;
      o.bend = 70;
      o.stalk = 0.2F;
      expect_sound(organ_mesh(o));
    }
  }
  Organ leaf;
  EXPECT_EQ((leaf.segments = 1, organ_mesh(leaf).triangles.size()), 2U);
  EXPECT_EQ((leaf.segments = 4, organ_mesh(leaf).triangles.size()), 12U);
  // A flat blade: upper side up, tip at its length.
  const TriangleMesh flat = organ_mesh(leaf);
  for (const UVec3& t : flat.triangles) {
    const Vec3 n = glm::cross(flat.positions[t.y] - flat.positions[t.x],
                              flat.positions[t.z] - flat.positions[t.x]);
    EXPECT_GT(n.z, 0);
  }
  EXPECT_EQ(flat.bounds().high.x, 1);
}

TEST(Geometry, NamesAnOrganThatIsNotDescribed) {
  const Plant plant = parse_plant("organ L length 1\naxiom: F~K\n", "test.lsys");
  Progress progress;
  try {
    grow(plant, {}, progress);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(error.message().find("'~K' is not described by an 'organ K' line"),
              std::string::npos);
  }
}

TEST(Geometry, RefusesToScaleWhatHasNoHeight) {
  const Plant plant = parse_plant("height 2\naxiom: &(180)F\n", "test.lsys");
  Progress progress;
  TriangleMesh mesh;
  EXPECT_THROW(mesh = grow(plant, {}, progress), Error);
}

}  // namespace
}  // namespace wold
