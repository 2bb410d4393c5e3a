#include "raster/canopy_shade.hpp"

#include <gtest/gtest.h>

namespace wold {
namespace {

/// One horizontal leaf of `side` m, so many metres above its foot.
Model leaf(float side, float above) {
  Model model;
  const float h = side / 2;
  for (const Vec2 c : {Vec2(-h, -h), Vec2(h, -h), Vec2(h, h), Vec2(-h, h)})
    model.mesh.positions.emplace_back(c, above);
  model.mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  model.mesh.parts = {{"leaf", 0, 2}};
  model.part_materials = {0};
  return model;
}

World world_of(Model model) {
  Heightfield field;
  field.height = Grid<float>(17, 17, 0);
  field.cell = 20;
  field.origin = DVec2(-160);
  Material green;
  green.color1 = Vec3(0.2F);
  green.color2 = Vec3(0.3F);
  green.transmission = Vec3(0.1F);
  World world{Ground(field, {}, {}, 1), {SurfaceMaterial(green)}, {std::move(model)}, {}, Sky{}};
  return world;
}

/// m² of leaves over the map.
double leaf_area(const CanopyShade& shade) {
  const double cell = 1.0 / (static_cast<double>(shade.place.x) * shade.width);
  double sum = 0;
  for (std::size_t k = 0; k < shade.texels.size(); k += 4)
    sum += static_cast<double>(shade.texels[k]) * cell * cell;
  return sum;
}

TEST(CanopyShade, HasTheLeavesOfAllCrownsAtTheirHeight) {
  World world = world_of(leaf(30, 8));
  world.instances = {{.position = {20, 10, 100}}, {.position = {-60, 40, 100}, .scale = 2}};
  const CanopyShade shade = canopy_shade(world);
  EXPECT_NEAR(leaf_area(shade), 900 * (1 + 4), 150);
  for (std::size_t k = 0; k < shade.texels.size(); k += 4) {
    const float area = shade.texels[k];
    const float top = shade.texels[k + 2];
    EXPECT_TRUE(area == 0 || (top > 107.9F * area && top < 116.1F * area));
  }
}

TEST(CanopyShade, LeavesOutLowPlantsAndLandWithoutAny) {
  World world = world_of(leaf(1, 0.5F));
  world.instances = {{.position = {20, 10, 0}}};
  EXPECT_TRUE(canopy_shade(world).texels.empty());
  EXPECT_EQ(canopy_shade(world).place, Vec4(0));
}

TEST(UndergrowthShade, HasTheLeavesAboutTheEyeAndNoOthers) {
  const World world = world_of(leaf(2, 0.5F));
  const std::vector<ModelInstance> plants{
      {.position = {100, 50, 0}}, {.position = {104, 47, 0}}, {.position = {130, 50, 0}}};
  const CanopyShade shade = undergrowth_shade(world, plants, {101, 49}, 20);
  EXPECT_NEAR(leaf_area(shade), 2 * 4, 0.6);
  // 4 m² over a disc whose mean square radius is that of the corners: 2 m wide to each side.
  const Vec2 at =
      Vec2(shade.place.z, shade.place.w) + Vec2(shade.place.x, shade.place.y) * Vec2(100, 50);
  const auto i = static_cast<std::size_t>(at.x * static_cast<float>(shade.width));
  const auto j = static_cast<std::size_t>(at.y * static_cast<float>(shade.height));
  const std::size_t k = 4 * (j * static_cast<std::size_t>(shade.width) + i);
  EXPECT_NEAR(shade.texels[k], 1 / pi, 0.03F);
  // The leaves reflect 1/4 of the light and let 1/10 through.
  for (std::size_t c = 1; c < 4; ++c)
    EXPECT_NEAR(shade.texels[k + c], 0.35F * shade.texels[k], 1e-5F);
  EXPECT_TRUE(undergrowth_shade(world, {}, {0, 0}, 20).texels.empty());
}

}  // namespace
}  // namespace wold
