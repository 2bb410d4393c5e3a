#include "terrain/analysis.hpp"

#include "base/parallel.hpp"
#include "testing.hpp"

namespace wold {
namespace {

using testing_terrain::field_of;

TEST(Analysis, PlaneHasItsSlopeUpToTheEdge) {
  const double rise = std::tan(radians(30.0));
  const Heightfield field =
      field_of(12, 9, 4, {0, 0}, [&](DVec2 p) { return rise * (0.6 * p.x + 0.8 * p.y); });
  const Grid<float> slope = slope_map(field);
  const Grid<float> curvature = curvature_map(field);
  const Grid<Vec3> normals = normal_map(field);
  for (int j = 0; j < 9; ++j)
    for (int i = 0; i < 12; ++i) {
      ASSERT_NEAR(slope(i, j), 30, 1e-3);
      ASSERT_NEAR(curvature(i, j), 0, 1e-5);
      ASSERT_NEAR(normals(i, j).z, std::cos(radians(30.0)), 1e-5);
      ASSERT_NEAR(normals(i, j).y, -0.8 * std::sin(radians(30.0)), 1e-5);
    }
}

TEST(Analysis, BowlHasItsLaplacian) {
  const Heightfield field =
      field_of(9, 9, 0.5, {-2, -2}, [](DVec2 p) { return 0.5 * p.x * p.x + 0.25 * p.y * p.y; });
  const Grid<float> curvature = curvature_map(field);
  for (const float c : curvature.values()) ASSERT_NEAR(c, 1.5, 1e-4);
}

TEST(Analysis, StatisticsOfARamp) {
  const Heightfield field = field_of(101, 3, 1, {0, 0}, [](DVec2 p) { return p.x - 20; });
  for (const int threads : {1, 2, 4}) {
    const ThreadLimit limit(threads);
    const HeightStatistics s = height_statistics(field);
    EXPECT_EQ(s.min, -20);
    EXPECT_EQ(s.max, 80);
    EXPECT_EQ(s.mean, 30);
  }
}

TEST(Analysis, HillshadeIsLambertsCosine) {
  const Heightfield level = field_of(4, 4, 1, {0, 0}, [](DVec2) { return 0; });
  EXPECT_NEAR(hillshade(level, {.elevation = 30, .ambient = 0})(1, 1), 0.5, 1e-6);
  const Heightfield to_north_west =
      field_of(4, 4, 1, {0, 0}, [](DVec2 p) { return p.x - p.y; });  // falls to the north-west
  const Heightfield to_south_east = field_of(4, 4, 1, {0, 0}, [](DVec2 p) { return p.y - p.x; });
  EXPECT_GT(hillshade(to_north_west)(1, 1), 0.8);
  EXPECT_EQ(hillshade(to_south_east, {.elevation = 20})(1, 1), 0.15F);
}

}  // namespace
}  // namespace wold
