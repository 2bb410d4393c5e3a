#include "terrain/heightfield.hpp"

#include "testing.hpp"

namespace wold {
namespace {

using testing_terrain::field_of;

const auto tilted = [](DVec2 p) { return 0.3 * p.x - 0.7 * p.y + 11; };

TEST(Heightfield, PlaneIsExactInsideAndAtEveryBorder) {
  for (const IVec2 size : {IVec2(17, 9), IVec2(4, 5), IVec2(3, 3), IVec2(2, 2)}) {
    const Heightfield field = field_of(size.x, size.y, 2.5, {-8, 3}, tilted);
    const DVec2 extent = field.size();
    for (double v = 0; v <= 1; v += 1.0 / 16) {
      for (double u = 0; u <= 1; u += 1.0 / 16) {
        const DVec2 place = field.origin + DVec2(u, v) * extent;
        const GroundSample ground = ground_at(field, place);
        ASSERT_NEAR(ground.height, tilted(place), 1e-4);
        ASSERT_NEAR(ground.gradient.x, 0.3, 1e-4);
        ASSERT_NEAR(ground.gradient.y, -0.7, 1e-4);
        ASSERT_NEAR(height_at(field, place), tilted(place), 1e-4);
      }
    }
  }
}

TEST(Heightfield, PassesThroughItsSamples) {
  const Heightfield field = field_of(
      12, 10, 0.7, {100, -40}, [](DVec2 p) { return 5 * std::sin(3 * p.x) * std::cos(2 * p.y); });
  for (int j = 0; j < 10; ++j)
    for (int i = 0; i < 12; ++i) {
      const DVec2 place = field.origin + field.cell * DVec2(i, j);
      ASSERT_NEAR(ground_at(field, place).height, field.height(i, j), 1e-4);
      ASSERT_NEAR(height_at(field, place), field.height(i, j), 1e-4);
    }
}

TEST(Heightfield, QuadraticIsExactInside) {
  const auto bowl = [](DVec2 p) { return 0.1 * p.x * p.x + 0.2 * p.x * p.y - 0.3 * p.y * p.y; };
  const Heightfield field = field_of(20, 20, 1, {-10, -10}, bowl);
  for (double t = -7.9; t < 7; t += 0.37) {
    const DVec2 place(t, 0.5 * t - 1);
    const GroundSample ground = ground_at(field, place);
    EXPECT_NEAR(ground.height, bowl(place), 1e-4);
    EXPECT_NEAR(ground.gradient.x, 0.2 * place.x + 0.2 * place.y, 1e-4);
    EXPECT_NEAR(ground.gradient.y, 0.2 * place.x - 0.6 * place.y, 1e-4);
  }
}

TEST(Heightfield, HeightAndGradientAreContinuous) {
  Heightfield field = field_of(9, 9, 1, {0, 0}, [](DVec2) { return 0; });
  for (std::size_t k = 0; k < field.height.size(); ++k)
    field.height.values()[k] = static_cast<float>((k * 7919) % 31);
  for (double y : {0.3, 4.0, 7.99})
    for (int i = 1; i < 8; ++i) {
      const GroundSample before = ground_at(field, {i - 1e-6, y});
      const GroundSample after = ground_at(field, {i + 1e-6, y});
      EXPECT_NEAR(before.height, after.height, 1e-3);
      EXPECT_NEAR(before.gradient.x, after.gradient.x, 1e-3);
      EXPECT_NEAR(before.gradient.y, after.gradient.y, 1e-3);
    }
}

TEST(Heightfield, OutsideIsTheNearestPlaceOnTheBorder) {
  const Heightfield field = field_of(8, 8, 1, {0, 0}, tilted);
  EXPECT_EQ(ground_at(field, {-5, 3.5}).height, ground_at(field, {0, 3.5}).height);
  EXPECT_EQ(ground_at(field, {100, 100}).height, ground_at(field, {7, 7}).height);
  EXPECT_EQ(height_at(field, {3, -9}), height_at(field, {3, 0}));
  EXPECT_TRUE(field.contains({7, 7}));
  EXPECT_FALSE(field.contains({7.01, 7}));
}

TEST(Heightfield, NormalOfAGradient) {
  const Vec3 normal = normal_of({1, 0});
  EXPECT_NEAR(normal.x, -std::sqrt(0.5F), 1e-6);
  EXPECT_NEAR(normal.z, std::sqrt(0.5F), 1e-6);
}

}  // namespace
}  // namespace wold
