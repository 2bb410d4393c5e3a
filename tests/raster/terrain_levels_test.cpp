#include "raster/terrain_levels.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <vector>

#include "terrain_testing.hpp"

namespace wold {
namespace {

using testing::varied_ground;

/// A view that leaves nothing out.
DrawView all_around(Vec3 eye, float pixel_angle) {
  DrawView view;
  view.eye = eye;
  view.pixel_angle = pixel_angle;
  for (Vec4& p : view.planes) p = Vec4(0, 0, 0, 1);
  return view;
}

std::vector<Vec3> eyes(const Ground& ground) {
  const float h = ground.base({50, 60}).height;
  return {{50, 60, h + 1.7F}, {50, 60, h + 100}, {-900, 300, 900}, {1400, 1500, 300}};
}

using Place = std::pair<float, float>;

/// Vertices along the four edges of a tile after morphing.
std::vector<std::vector<Place>> edges(const TerrainChoice& c, const TerrainTile& t) {
  std::vector<std::vector<Place>> list(4);
  const auto add = [&](int edge, int i, int j) {
    const Vec2 v = c.vertex(t, i, j);
    list[static_cast<std::size_t>(edge)].emplace_back(v.x, v.y);
  };
  for (int k = 0; k <= c.cells; ++k) {
    add(0, k, 0);
    add(1, k, c.cells);
    add(2, 0, k);
    add(3, c.cells, k);
  }
  return list;
}

TEST(TerrainLevels, TilesCoverTheGroundOnce) {
  const Ground ground = varied_ground();
  const TerrainLevels levels(ground);
  for (const Vec3& eye : eyes(ground)) {
    const TerrainChoice c = levels.choose(all_around(eye, 2e-3F), {.most_tiles = 100000});
    double area = 0;
    for (const TerrainTile& t : c.tiles) area += std::pow(static_cast<double>(t.step) * c.cells, 2);
    const DVec2 size = (ground.high() - ground.low()) / c.unit;
    EXPECT_NEAR(area, size.x * size.y, 1e-9 * area);
  }
}

// Every vertex on an edge shared by two tiles is a vertex of both, to the last bit.
TEST(TerrainLevels, SharedEdgesAgree) {
  const Ground ground = varied_ground();
  const TerrainLevels levels(ground);
  for (const Vec3& eye : eyes(ground))
    for (const float pixel_angle : {1e-2F, 2e-3F}) {
      const TerrainChoice c = levels.choose(all_around(eye, pixel_angle), {.most_tiles = 100000});
      // Edges by their line and place: vertical ones by x, horizontal ones by y.
      std::map<Place, std::set<Place>> owners;  // (tile corner on the line, line) to vertices
      std::map<Place, int> uses;
      std::map<Place, int> neighbours;
      for (const TerrainTile& t : c.tiles)
        for (const auto& edge : edges(c, t)) {
          const std::set<Place> distinct(edge.begin(), edge.end());
          for (const Place& p : distinct) ++uses[p];
        }
      // A vertex inside an edge belongs to two tiles, or lies on the border of the ground.
      const auto far = static_cast<float>(1e-3);
      const Vec2 low(ground.low() - c.anchor);
      const Vec2 high(ground.high() - c.anchor);
      int lonely = 0;
      for (const auto& [p, count] : uses) {
        const bool border = p.first < low.x + far || p.second < low.y + far ||
                            p.first > high.x - far || p.second > high.y - far;
        if (count < 2 && !border) ++lonely;
      }
      EXPECT_EQ(lonely, 0) << uses.size() << " vertices, eye " << eye.z;
    }
}

TEST(TerrainLevels, SpacingFollowsDistance) {
  const Ground ground = varied_ground();
  const TerrainLevels levels(ground);
  const Vec3 eye = eyes(ground)[0];
  const TerrainChoice c = levels.choose(all_around(eye, 2e-3F), {.most_tiles = 100000});
  for (const TerrainTile& t : c.tiles) {
    const Vec2 low = Vec2(t.x, t.y) * static_cast<float>(c.unit);
    const float size = t.step * static_cast<float>(c.unit) * static_cast<float>(c.cells);
    const float d = std::max(c.nearest, glm::distance(c.eye, glm::clamp(c.eye, low, low + size)));
    const float spacing = t.step * static_cast<float>(c.unit);
    EXPECT_TRUE(spacing <= 1.0001F * d / c.reach || spacing <= 0.02F) << spacing << " at " << d;
  }
}

// A short step of the eye moves no vertex by more than a small part of its tile's spacing.
TEST(TerrainLevels, VerticesMoveWithoutJumps) {
  const Ground ground = varied_ground();
  const TerrainLevels levels(ground);
  const auto surface_vertices = [&](Vec3 eye) {
    const TerrainChoice c = levels.choose(all_around(eye, 4e-3F), {.least_spacing = 0.5F});
    std::vector<DVec2> list;
    for (const TerrainTile& t : c.tiles)
      for (int j = 0; j <= c.cells; ++j)
        for (int i = 0; i <= c.cells; ++i) list.push_back(c.anchor + DVec2(c.vertex(t, i, j)));
    std::sort(list.begin(), list.end(),
              [](DVec2 a, DVec2 b) { return std::pair(a.x, a.y) < std::pair(b.x, b.y); });
    return list;
  };
  // Every vertex of the first has one of the second close to it, and the other way round.
  const auto covered = [](const std::vector<DVec2>& a, const std::vector<DVec2>& b, double most) {
    for (const DVec2& p : a) {
      auto near = std::lower_bound(b.begin(), b.end(), p.x - most,
                                   [](DVec2 q, double x) { return q.x < x; });
      bool found = false;
      for (; near != b.end() && near->x <= p.x + most && !found; ++near)
        found = std::abs(near->y - p.y) <= most;
      if (!found) return false;
    }
    return true;
  };
  const Vec3 eye = eyes(ground)[1];
  for (int k = 0; k < 6; ++k) {
    const Vec3 here = eye + Vec3(17.0F * static_cast<float>(k), 0, 9.0F * static_cast<float>(k));
    const auto a = surface_vertices(here);
    const auto b = surface_vertices(here + Vec3(0.05F, 0.03F, 0));
    EXPECT_TRUE(covered(a, b, 0.25) && covered(b, a, 0.25)) << k;
  }
}

TEST(TerrainLevels, BoundsHoldTheDrawnHeights) {
  const Ground ground = varied_ground();
  const TerrainLevels levels(ground);
  for (const DVec2& p : testing::places(3000, DVec2(0), 1270)) {
    const Range range = levels.heights(p, 0);
    const float h = ground.detailed(p, 0.1F).height;
    EXPECT_TRUE(range.low <= h && h <= range.high) << h << " in " << range.low << range.high;
    if (ground.field().contains(p)) {
      EXPECT_LT(range.high - range.low, 200);
    }
  }
}

TEST(TerrainLevels, LeavesOutWhatIsNotSeen) {
  const Ground ground = varied_ground();
  const TerrainLevels levels(ground);
  Camera camera;
  camera.position = eyes(ground)[0];
  const DrawView view = camera_view(camera, 320, 180);
  const TerrainChoice seen = levels.choose(view, {});
  const TerrainChoice all = levels.choose(all_around(view.eye, view.pixel_angle), {});
  EXPECT_GT(seen.tiles.size(), 0U);
  EXPECT_LT(seen.tiles.size(), all.tiles.size() / 2);
  camera.direction = {0, 0, 1};
  EXPECT_EQ(levels.choose(camera_view(camera, 320, 180), {}).tiles.size(), 0U);
}

TEST(TerrainLevels, KeepsToTheMostTiles) {
  const Ground ground = varied_ground();
  const TerrainLevels levels(ground);
  const DrawView view = all_around(eyes(ground)[0], 5e-4F);
  EXPECT_LE(levels.choose(view, {.pixels_per_vertex = 1, .most_tiles = 1500}).tiles.size(), 1500U);
}

}  // namespace
}  // namespace wold
