// Light whose amount is known in closed form.

#include "render/path_tracer.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/parallel.hpp"
#include "sky/spectrum.hpp"
#include "testing.hpp"

namespace wold {
namespace {

using testing::mean_radiance;
using testing::picture;
using testing::Stage;

constexpr float ground_albedo = 0.8F;

World plane_world(const SkySettings& sky, Vec3 reflectance = Vec3(ground_albedo)) {
  return {Ground(testing::flat(4000), {}, testing::plain(reflectance), 1), {}, {}, {}, Sky(sky)};
}

/// A plane of `reflectance` and, 2 m above it, a wide thin sheet.
World sheet_world(const SkySettings& sky, float reflectance, float sheet_reflectance,
                  float sheet_transmittance) {
  World world = plane_world(sky, Vec3(reflectance));
  world.materials.emplace_back(testing::sheet(Vec3(sheet_reflectance), Vec3(sheet_transmittance)));
  world.models.push_back({testing::square(3000), {0}});
  ModelInstance sheet;
  sheet.position = {0, 0, 2};
  world.instances.push_back(sheet);
  return world;
}

Camera looking(float z, Vec3 direction) {
  Camera camera;
  camera.position = {0, 0, z};
  camera.direction = direction;
  return camera;
}

/// Sunlight on a horizontal surface, lx.
DVec3 sun_on_ground(const Sky& sky) {
  return DVec3(sky.sun_irradiance()) * static_cast<double>(sky.sun_direction().z);
}

void expect_near(DVec3 value, DVec3 expected, double relative) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(value[c], expected[c], relative * expected[c]);
}

TEST(PathTracer, SunOnAPlane) {
  const Stage stage(plane_world(testing::sky(1, 0)));
  const DVec3 expected = sun_on_ground(stage.world.sky) * static_cast<double>(ground_albedo) / pi_d;
  const Image image = picture(*stage.rays, looking(10, {0, 0, -1}), {16, 16}, 16, 0);
  expect_near(mean_radiance(image), expected, 0.01);
}

TEST(PathTracer, SkyOnAPlane) {
  // Sky and surface sampled together must not count light twice, nor miss any.
  const Stage stage(plane_world(testing::sky(0, 1)));
  const DVec3 expected =
      DVec3(stage.world.sky.sky_irradiance()) * static_cast<double>(ground_albedo) / pi_d;
  const Image image = picture(*stage.rays, looking(10, {0, 0, -1}), {16, 16}, 256, 1);
  expect_near(mean_radiance(image), expected, 0.02);
}

TEST(PathTracer, AThinSheetLetsLightThroughAndReflects) {
  const Stage stage(sheet_world(testing::sky(1, 0), 0, 0.4F, 0.5F));
  const DVec3 light = sun_on_ground(stage.world.sky) / pi_d;
  const Image below = picture(*stage.rays, looking(1, {0, 0, 1}), {16, 16}, 16, 0);
  expect_near(mean_radiance(below), 0.5 * light, 0.01);
  const Image above = picture(*stage.rays, looking(9, {0, 0, -1}), {16, 16}, 16, 0);
  expect_near(mean_radiance(above), 0.4 * light, 0.01);
}

TEST(PathTracer, NoLightComesThroughOpaqueGround) {
  // Rough detail on a white plain tilts normals for shading by far more than the mesh, which is
  // diced more coarsely: directions below the mesh must not find the sky beneath it.
  GroundMaterial rough = testing::plain(Vec3(0.95F));
  rough.detail = 5;
  World world{Ground(testing::flat(4000), {}, rough, 1), {}, {}, {}, Sky(testing::sky(0, 1))};
  const Stage stage(std::move(world));
  const double most = luminance(DVec3(stage.world.sky.sky_irradiance())) / pi_d;
  const Image image = picture(*stage.rays, looking(10, {0, 0, -1}), {16, 16}, 64, 6);
  EXPECT_LT(luminance(mean_radiance(image)), most);
}

TEST(PathTracer, LightBetweenTwoSurfacesIsAGeometricSeries) {
  // E_ground = τ E / (1 - ρ_sheet ρ_ground); Russian roulette must not change it.
  const Stage stage(sheet_world(testing::sky(1, 0), 0.9F, 0.5F, 0.4F));
  const DVec3 on_ground = 0.4 * sun_on_ground(stage.world.sky) / (1 - 0.5 * 0.9);
  const Image ground = picture(*stage.rays, looking(1, {0, 0, -1}), {24, 24}, 512, 64);
  expect_near(mean_radiance(ground), 0.9 / pi_d * on_ground, 0.015);
}

TEST(PathTracer, WhiteSurfacesNeverGiveMoreThanTheyGet) {
  // All that enters between the planes leaves through the sheet: with 95 % kept at each surface,
  // the ground gets τ / (1 - ρ_sheet ρ_ground) < 1 of what falls on the sheet.
  const Stage stage(sheet_world(testing::sky(1, 1), 0.95F, 0.475F, 0.475F));
  const DVec3 most = sun_on_ground(stage.world.sky) + DVec3(stage.world.sky.sky_irradiance());
  const Image image = picture(*stage.rays, looking(1, {0, 0, -1}), {16, 16}, 256, 64);
  const DVec3 radiance = mean_radiance(image);
  for (int c = 0; c < 3; ++c) {
    EXPECT_LT(radiance[c], most[c] / pi_d);
    EXPECT_GT(radiance[c], 0.5 * most[c] / pi_d);
  }
}

TEST(PathTracer, AShadowHasNoSun) {
  World world = plane_world(testing::sky(1, 0));
  world.materials.emplace_back(testing::sheet(Vec3(0.5F), Vec3(0)));
  world.models.push_back({testing::square(4), {0}});
  ModelInstance roof;
  roof.position = {100, 50, 30};
  world.instances.push_back(roof);
  const Vec3 sun = world.sky.sun_direction();
  const Stage stage(std::move(world));
  const Vec3 shadow = roof.position - sun * (roof.position.z / sun.z);
  Camera camera;
  camera.position = shadow + Vec3(0, 0, 5);
  camera.direction = {0, 0, -1};
  camera.field_of_view = 5;
  EXPECT_EQ(mean_radiance(picture(*stage.rays, camera, {4, 4}, 16, 0)), DVec3(0));
  camera.position += Vec3(8, 0, 0);
  EXPECT_GT(mean_radiance(picture(*stage.rays, camera, {4, 4}, 16, 0)).y, 1000);
}

TEST(PathTracer, LayersOfAPlane) {
  const Stage stage(plane_world(testing::sky(1, 1)));
  const Camera camera = looking(10, glm::normalize(Vec3(0, 1, -0.2F)));
  constexpr int width = 64;
  constexpr int height = 48;
  const CameraRays rays(camera, width, height);
  const Image image = picture(*stage.rays, camera, {width, height}, 1, 2, 0);
  int ground = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const Vec3 d = rays.ray(Vec2(x, y) + 0.5F, Vec2(0)).direction;
      if (d.z > 0) {
        EXPECT_EQ(image.at(x, y, image.find("A")), 0);
      }
      if (d.z > -0.02F) continue;
      ++ground;
      EXPECT_EQ(image.at(x, y, image.find("A")), 1);
      const float depth = 10 / -d.z;
      EXPECT_NEAR(image.at(x, y, image.find("depth.Z")), depth, 1e-3F * depth);
      EXPECT_NEAR(image.at(x, y, image.find("albedo.G")), ground_albedo, 1e-4F);
      EXPECT_NEAR(image.at(x, y, image.find("normal.X")), 0, 1e-4F);
      EXPECT_NEAR(image.at(x, y, image.find("normal.Z")), 1, 1e-4F);
    }
  EXPECT_GT(ground, width * height / 2);
}

TEST(PathTracer, SameBitsForAnyNumberOfThreads) {
  const Stage stage(sheet_world(testing::sky(1, 1), 0.5F, 0.4F, 0.3F));
  const auto with = [&](int threads) {
    const ThreadLimit limit(threads);
    return picture(*stage.rays, looking(1, {0, 1, 0.1F}), {40, 30}, 4, 6).pixels;
  };
  const std::vector<float> one = with(1);
  EXPECT_EQ(with(2), one);
  EXPECT_EQ(with(4), one);
}

TEST(PathTracer, ACancelledPictureIsKeptSoFar) {
  const Stage stage(plane_world(testing::sky(1, 1)));
  const Camera camera = looking(10, {0, 1, -0.2F});
  Film film(64, 48);
  Progress* running = nullptr;
  int reports = 0;
  Progress progress([&](const ProgressReport&) {
    if (++reports == 4) running->cancel();
  });
  running = &progress;
  try {
    trace_picture(*stage.rays, CameraRays(camera, 64, 48), {}, {{0, 1U << 20U}, 1, false}, film,
                  progress);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::cancelled);
  }
  EXPECT_GT(film.least_samples(), 0U);
}

}  // namespace
}  // namespace wold
