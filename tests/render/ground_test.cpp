#include "render/ground.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/hash.hpp"
#include "render/ground_mesh.hpp"
#include "testing.hpp"

namespace wold {
namespace {

double random(int k, int which) {
  return uniform_double(random_bits(5, k, which));
}

Heightfield hills(double size, double centre_x, int samples, float lift) {
  Heightfield field;
  field.height = Grid<float>(samples, samples);
  field.cell = size / (samples - 1);
  field.origin = DVec2(centre_x - size / 2, -size / 2);
  for (int j = 0; j < samples; ++j)
    for (int i = 0; i < samples; ++i) {
      const DVec2 p = field.origin + field.cell * DVec2(i, j);
      field.height(i, j) =
          lift + static_cast<float>(40 * std::sin(p.x / 70) * std::cos(p.y / 90) + 0.02 * p.x);
    }
  return field;
}

/// The surroundings are coarser and do not quite fit: they must be made to.
Ground hilly_ground(float detail = 0) {
  GroundMaterial material;
  material.detail = detail;
  material.distant_forest = 0;
  return {hills(400, 0, 129, 0), hills(1600, 0, 65, 3), material, 7};
}

TEST(Ground, MeetsItsSurroundingsWithoutAStep) {
  const Ground ground = hilly_ground();
  for (int k = 0; k < 2000; ++k) {
    const double along = 400 * (random(k, 0) - 0.5);
    constexpr double in = 199.9999;
    constexpr double out = 200.0001;
    const bool east = k % 2 == 0;
    const double sign = k % 4 < 2 ? 1 : -1;
    const DVec2 a = east ? DVec2(sign * in, along) : DVec2(along, sign * in);
    const DVec2 b = east ? DVec2(sign * out, along) : DVec2(along, sign * out);
    EXPECT_NEAR(ground.base(a).height, ground.base(b).height, 2e-3F);
  }
  EXPECT_EQ(ground.low(), DVec2(-800));
  EXPECT_EQ(ground.high(), DVec2(800));
}

TEST(Ground, IsContinuousAwayFromTheFieldToo) {
  const Ground ground = hilly_ground();
  for (int k = 0; k < 4000; ++k) {
    const DVec2 p = 2400.0 * (DVec2(random(k, 0), random(k, 1)) - 0.5);
    const double angle = 2 * pi_d * random(k, 2);
    const DVec2 q = p + 1e-3 * DVec2(std::cos(angle), std::sin(angle));
    EXPECT_NEAR(ground.base(p).height, ground.base(q).height, 5e-3F);
  }
}

TEST(Ground, IsItsFieldInside) {
  const Ground ground = hilly_ground();
  for (int k = 0; k < 500; ++k) {
    const DVec2 p = 400.0 * (DVec2(random(k, 0), random(k, 1)) - 0.5);
    EXPECT_EQ(ground.base(p).height, ground_at(ground.field(), p).height);
  }
}

TEST(Ground, DetailsGradientIsItsSlope) {
  const Ground ground = hilly_ground(1);
  for (int k = 0; k < 300; ++k) {
    const DVec2 p = 380.0 * (DVec2(random(k, 0), random(k, 1)) - 0.5);
    constexpr float spacing = 0.5F;
    constexpr double h = 0.01;
    const auto height = [&](DVec2 at) {
      return static_cast<double>(ground.detailed(at, spacing).height);
    };
    const GroundSample s = ground.detailed(p, spacing);
    // The mix of soil and stone changes too: a few per cent.
    EXPECT_NEAR(s.gradient.x, (height(p + DVec2(h, 0)) - height(p - DVec2(h, 0))) / (2 * h), 0.06);
    EXPECT_NEAR(s.gradient.y, (height(p + DVec2(0, h)) - height(p - DVec2(0, h))) / (2 * h), 0.06);
  }
}

TEST(Ground, SurfacesKeepEnergyAndUnitNormals) {
  const Ground ground = hilly_ground(1);
  for (int k = 0; k < 3000; ++k) {
    const DVec2 p = 1600.0 * (DVec2(random(k, 0), random(k, 1)) - 0.5);
    const GroundSurface s = ground.surface(p, static_cast<float>(0.001 + 5 * random(k, 2)));
    EXPECT_NEAR(glm::length(s.normal), 1, 1e-5F);
    EXPECT_GT(s.normal.z, 0);
    for (int c = 0; c < 3; ++c) {
      EXPECT_GE(s.reflectance[c], 0);
      EXPECT_LE(s.reflectance[c], 1);
    }
  }
}

Camera eye() {
  Camera camera;
  camera.position = {20, -150, 60};
  camera.direction = {0, 1, -0.1F};
  return camera;
}

std::vector<GroundTile> diced(const Ground& ground) {
  return dice_ground(ground, eye(), CameraRays(eye(), 320, 180), {});
}

TEST(GroundMesh, TilesCoverTheGroundOnce) {
  const Ground ground = hilly_ground();
  double area = 0;
  for (const GroundTile& tile : diced(ground)) area += tile.size * tile.size;
  EXPECT_NEAR(area, 1600.0 * 1600.0, 1);
}

TEST(GroundMesh, SpacingIsAsFineAsTheViewAsks) {
  const Ground ground = hilly_ground();
  const CameraRays rays(eye(), 320, 180);
  const GroundDicing dicing;
  int seen = 0;
  for (const GroundTile& tile : diced(ground)) {
    const DVec2 middle = tile.low + DVec2(tile.size / 2);
    const Vec3 place(Vec2(middle), ground.base(middle).height);
    const Vec3 pixel = rays.project(place);
    if (pixel.z <= 0 || pixel.x < 0 || pixel.x > 320 || pixel.y < 0 || pixel.y > 180) continue;
    ++seen;
    const float distance = glm::distance(place, eye().position);
    EXPECT_LE(tile.spacing(), 1.05F * dicing.spacing_pixels * rays.pixel_angle() * distance);
  }
  EXPECT_GT(seen, 50);
}

TEST(GroundMesh, IsFineUnderACameraOnASteepSlope) {
  // The middle of a large tile is far below the camera, the ground at its feet is not.
  Heightfield slope = testing::flat(1600);
  for (int j = 0; j < 17; ++j)
    for (int i = 0; i < 17; ++i) slope.height(i, j) = -600 * static_cast<float>(std::abs(i - 8));
  const Ground ground(slope, {}, testing::plain(Vec3(0.5F)), 1);
  Camera camera;
  camera.position = Vec3(3, 7, ground.base({3, 7}).height + 2);
  const CameraRays rays(camera, 64, 36);
  const GroundDicing dicing;
  for (const GroundTile& tile : dice_ground(ground, camera, rays, dicing)) {
    const DVec2 place(camera.position.x, camera.position.y);
    if (glm::clamp(place, tile.low, tile.low + DVec2(tile.size)) != place) continue;
    EXPECT_LE(tile.spacing(), 2 * dicing.spacing_outside * rays.pixel_angle());
  }
}

TEST(GroundMesh, NoMoreTilesThanAllowed) {
  const Ground ground = hilly_ground();
  GroundDicing dicing;
  dicing.most_tiles = 300;
  const auto tiles = dice_ground(ground, eye(), CameraRays(eye(), 3200, 1800), dicing);
  EXPECT_LE(tiles.size(), 300U);
  EXPECT_GT(tiles.size(), 30U);
}

/// The ground as diced for the camera, as rays see it.
struct DicedStage {
  World world;
  std::vector<GroundTile> tiles;
  Progress progress;
  ModelTrees trees;
  RayScene rays;

  explicit DicedStage(Ground ground)
      : world{std::move(ground), {}, {}, {}, Sky(testing::sky(1, 1))},
        tiles(diced(world.ground)),
        trees(world.models, progress),
        rays(world, trees, tiles, progress) {}
};

TEST(GroundMesh, HasNoHolesFromAbove) {
  const DicedStage stage(hilly_ground(1));
  RayCount count;
  for (int k = 0; k < 50000; ++k) {
    DVec2 p = 1599.9 * (DVec2(random(k, 0), random(k, 1)) - 0.5);
    if (k % 2 == 0) {  // on a border between tiles
      const GroundTile& tile = stage.tiles[static_cast<std::size_t>(k) % stage.tiles.size()];
      p = tile.low +
          tile.size * DVec2(k % 4 == 0 ? 0 : random(k, 2), k % 4 == 0 ? random(k, 2) : 0);
      p = glm::clamp(p, DVec2(-799.9), DVec2(799.9));
    }
    const Hit hit = stage.rays.intersect({Vec3(Vec2(p), 500), {0, 0, -1}}, 0, false, count);
    ASSERT_TRUE(hit.valid()) << p.x << ' ' << p.y;
    ASSERT_NEAR(hit.position.z, stage.world.ground.base(p).height, 1.5F) << p.x << ' ' << p.y;
  }
}

TEST(GroundMesh, HasNoCracksFromTheSide) {
  // Rays at the borders between tiles meet the ground before they are under it.
  const DicedStage stage(hilly_ground());
  RayCount count;
  int tried = 0;
  for (int k = 0; k < 50000; ++k) {
    const GroundTile& tile = stage.tiles[static_cast<std::size_t>(k) % stage.tiles.size()];
    const double t = random(k, 0);
    const DVec2 p = glm::clamp(tile.low + tile.size * (k % 2 == 0 ? DVec2(0, t) : DVec2(t, 0)),
                               DVec2(-790), DVec2(790));
    const auto angle = static_cast<float>(2 * pi_d * random(k, 1));
    const auto sink = static_cast<float>(-0.1 - 0.4 * random(k, 2));
    const Vec3 direction = glm::normalize(Vec3(std::cos(angle), std::sin(angle), sink));
    const auto spacing = static_cast<float>(tile.spacing());
    // A place under the ground by more than a mesh departs from it, by less than a skirt hangs.
    const Vec3 aim(Vec2(p), stage.world.ground.base(p).height - 0.1F - 0.3F * spacing);
    const Vec3 from = aim - (3 + 8 * spacing) * direction;
    if (from.z < stage.world.ground.base(DVec2(Vec2(from))).height + 0.2F + spacing) continue;
    ++tried;
    const Hit hit = stage.rays.intersect({from, direction}, 0, false, count);
    ASSERT_TRUE(hit.valid()) << p.x << ' ' << p.y;
    ASSERT_LT(hit.distance, glm::distance(from, aim)) << p.x << ' ' << p.y;
  }
  EXPECT_GT(tried, 5000);
}

TEST(Ground, NeverReflectsMoreThanItGets) {
  GroundMaterial white;
  white.rock_color1 = white.rock_color2 = white.soil_color1 = white.soil_color2 = Vec3(1);
  white.grass_color1 = white.grass_color2 = Vec3(1);
  white.rock_height = {-10, -5};
  for (const bool rock : {true, false}) {
    if (!rock) white.rock_height = {3000, 4000};
    const Ground ground(testing::flat(2000), {}, white, 3);
    for (int k = 0; k < 2000; ++k) {
      const Vec3 color = ground.surface(DVec2(0.37 * k - 400, 0.21 * k - 200), 0.05F).reflectance;
      EXPECT_LE(std::max({color.x, color.y, color.z}), 0.95F);
    }
  }
}

}  // namespace
}  // namespace wold
