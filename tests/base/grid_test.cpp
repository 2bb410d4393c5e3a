#include "base/grid.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace wold {
namespace {

Grid<int> numbered(int width, int height) {
  Grid<int> grid(width, height);
  std::iota(grid.values().begin(), grid.values().end(), 0);
  return grid;
}

TEST(Grid, KeepsValuesRowByRow) {
  Grid<int> grid = numbered(4, 3);
  EXPECT_EQ(grid.size(), 12U);
  EXPECT_EQ(grid(0, 0), 0);
  EXPECT_EQ(grid(3, 0), 3);
  EXPECT_EQ(grid(0, 1), 4);
  EXPECT_EQ(grid(3, 2), 11);
  grid(1, 2) = 70;
  EXPECT_EQ(grid.row(2)[1], 70);
  EXPECT_EQ(grid.row(1).size(), 4U);
}

TEST(Grid, BeginsWithOneValueAndComparesByValue) {
  const Grid<int> a(3, 2, 5);
  Grid<int> b = a;
  EXPECT_EQ(a, b);
  b(0, 0) = 1;
  EXPECT_NE(a, b);
  EXPECT_EQ(a(0, 0), 5);
  EXPECT_TRUE(a.same_shape(b));
  EXPECT_FALSE(a.same_shape(Grid<int>(2, 3)));
  EXPECT_NE(Grid<int>(3, 2), Grid<int>(2, 3));
  EXPECT_TRUE(Grid<int>().empty());
}

TEST(Grid, ClampedGivesTheNearestInside) {
  const Grid<int> grid = numbered(4, 3);
  EXPECT_EQ(grid.clamped(-5, -1), grid(0, 0));
  EXPECT_EQ(grid.clamped(9, 1), grid(3, 1));
  EXPECT_EQ(grid.clamped(2, 3), grid(2, 2));
}

TEST(Grid, SubViewSeesAndChangesThePart) {
  Grid<int> grid = numbered(6, 5);
  const GridView<int> part = grid.view().sub(2, 1, 3, 2);
  EXPECT_EQ(part.width(), 3);
  EXPECT_EQ(part.height(), 2);
  EXPECT_EQ(part(0, 0), grid(2, 1));
  EXPECT_EQ(part(2, 1), grid(4, 2));
  EXPECT_EQ(part.row(1).size(), 3U);
  EXPECT_EQ(part.clamped(9, 9), grid(4, 2));
  part(1, 1) = -1;
  EXPECT_EQ(grid(3, 2), -1);
  const GridView<const int> inner = part.sub(1, 1, 1, 1);
  EXPECT_EQ(inner(0, 0), -1);
}

}  // namespace
}  // namespace wold
