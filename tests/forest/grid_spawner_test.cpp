#include "forest/grid_spawner.hpp"

#include <gtest/gtest.h>

#include "base/error.hpp"

namespace wold {
namespace {

Heightfield flat() {
  Heightfield ground;
  ground.height = Grid<float>(101, 101, 7.0F);
  ground.origin = DVec2(-50);
  return ground;
}

std::vector<SpeciesSettings> two_species() {
  SpeciesSettings a;
  a.name = "oak";
  SpeciesSettings b;
  b.name = "fern";
  return {a, b};
}

TEST(GridSpawner, FillsEveryCellWithinItsShare) {
  GridSpawner grid;
  grid.cells = {5, 4};
  grid.cell_size = 2.5F;
  grid.offset = {0, 15};
  grid.position_spread = 0.4F;
  const auto plants = spawn_grid(flat(), grid, two_species(), {10, -3}, 1);
  ASSERT_EQ(plants.size(), 20U);
  for (int n = 0; n < 20; ++n) {
    const int row = n / 5;
    const Vec2 middle{10 + 2.5F * (static_cast<float>(n % 5) - 2),
                      12 + 2.5F * (static_cast<float>(row) - 1.5F)};
    const Instance& p = plants[static_cast<std::size_t>(n)];
    EXPECT_LE(std::abs(p.position.x - middle.x), 0.2F * 2.5F + 1e-5F);
    EXPECT_LE(std::abs(p.position.y - middle.y), 0.2F * 2.5F + 1e-5F);
    EXPECT_NEAR(p.position.z, 7, 1e-5);
    EXPECT_TRUE(grid.scale.contains(p.scale));
  }
}

TEST(GridSpawner, ProbabilityAndWeights) {
  GridSpawner grid;
  grid.cells = {80, 80};
  grid.cell_size = 1;
  grid.probability = 0.8F;
  grid.species = {{"oak", 1}, {"fern", 4}};
  const auto plants = spawn_grid(flat(), grid, two_species(), {0, 0}, 1);
  EXPECT_NEAR(static_cast<double>(plants.size()), 0.8 * 6400, 130);
  double ferns = 0;
  for (const Instance& p : plants) ferns += p.species;
  EXPECT_NEAR(ferns / static_cast<double>(plants.size()), 0.8, 0.025);
}

TEST(GridSpawner, LeavesOutWhatIsOffTheGround) {
  GridSpawner grid;
  grid.cells = {10, 10};
  grid.cell_size = 4;
  const auto plants = spawn_grid(flat(), grid, two_species(), {50, 0}, 1);
  EXPECT_EQ(plants.size(), 50U);
}

TEST(GridSpawner, Errors) {
  GridSpawner grid;
  grid.species = {{"ferm", 1}};
  try {
    spawn_grid(flat(), grid, two_species(), {0, 0}, 1);
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(),
                 "'species' in 'grid' names 'ferm', but no species is called that. Did you mean "
                 "'fern'?");
  }
  grid.species = {};
  grid.cells = {100000, 100000};
  EXPECT_THROW(spawn_grid(flat(), grid, two_species(), {0, 0}, 1), Error);
}

}  // namespace
}  // namespace wold
