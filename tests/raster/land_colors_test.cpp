#include "raster/land_colors.hpp"

#include <gtest/gtest.h>

namespace wold {
namespace {

TEST(LandColors, AreThoseOfTheLandInTheirPlaces) {
  // Rock in the east, where it is steep; level soil in the west.
  Heightfield field{Grid<float>(65, 65), {-320, -320}, 10};
  for (int j = 0; j < 65; ++j)
    for (int i = 0; i < 65; ++i)
      field.height(i, j) = i < 32 ? 0.0F : 15.0F * static_cast<float>(i - 32);
  GroundMaterial material;
  material.rock_color1 = material.rock_color2 = Vec3(0.5F);
  const Ground ground(field, {}, material, 1);
  const LandColors colors = land_colors(ground);
  const auto at = [&](Vec2 place) {
    const Vec2 t =
        Vec2(colors.place.z, colors.place.w) + Vec2(colors.place.x, colors.place.y) * place;
    const auto cell = [](float x, int cells) {
      return static_cast<int>(x * static_cast<float>(cells));
    };
    return colors.reflectance(cell(t.x, colors.reflectance.width()),
                              cell(t.y, colors.reflectance.height()));
  };
  EXPECT_NEAR(at({200, 0}).x, 0.5F, 0.05F);
  EXPECT_LT(at({-200, 0}).x, 0.35F);
}

}  // namespace
}  // namespace wold
