#include "render/camera.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "base/hash.hpp"

namespace wold {
namespace {

Vec2 random_pair(int k, int which) {
  return {uniform(random_bits(1, k, which, 0)), uniform(random_bits(1, k, which, 1))};
}

Camera oblique() {
  Camera camera;
  camera.position = {10, -20, 30};
  camera.direction = {0.3F, 0.8F, -0.2F};
  camera.field_of_view = 70;
  return camera;
}

TEST(Camera, ProjectTurnsARayBack) {
  for (const IVec2 size : {IVec2(640, 360), IVec2(300, 500)}) {
    const CameraRays rays(oblique(), size.x, size.y);
    for (int k = 0; k < 500; ++k) {
      const Vec2 pixel = random_pair(k, 0) * Vec2(size);
      const Ray ray = rays.ray(pixel, Vec2(0));
      EXPECT_NEAR(glm::length(ray.direction), 1, 1e-5F);
      const Vec3 back = rays.project(ray.origin + (5.0F + static_cast<float>(k)) * ray.direction);
      EXPECT_NEAR(back.x, pixel.x, 0.02F);
      EXPECT_NEAR(back.y, pixel.y, 0.02F);
      EXPECT_GT(back.z, 0);
    }
    EXPECT_LE(rays.project(Vec3(10, -20, 30) - oblique().direction).z, 0);
  }
}

TEST(Camera, FieldOfViewIsAcrossTheLongerSide) {
  for (const IVec2 size : {IVec2(640, 360), IVec2(360, 640)}) {
    const CameraRays rays(oblique(), size.x, size.y);
    const auto w = static_cast<float>(size.x);
    const auto h = static_cast<float>(size.y);
    const bool wide = w > h;
    const Vec3 a = rays.ray(wide ? Vec2(0, h / 2) : Vec2(w / 2, 0), Vec2(0)).direction;
    const Vec3 b = rays.ray(wide ? Vec2(w, h / 2) : Vec2(w / 2, h), Vec2(0)).direction;
    EXPECT_NEAR(degrees(std::acos(glm::dot(a, b))), 70, 0.01F);
    const Vec3 c = rays.ray({w / 2, h / 2}, Vec2(0)).direction;
    const Vec3 d = rays.ray({w / 2 + 1, h / 2}, Vec2(0)).direction;
    EXPECT_NEAR(glm::length(c - d), rays.pixel_angle(), 1e-3F * rays.pixel_angle());
  }
}

TEST(Camera, TheTopOfThePictureIsUpAndItsRightIsRight) {
  Camera camera;
  camera.direction = {0, 1, 0};
  const CameraRays rays(camera, 100, 100);
  EXPECT_GT(rays.ray({50, 0}, Vec2(0)).direction.z, 0.1F);
  EXPECT_GT(rays.ray({100, 50}, Vec2(0)).direction.x, 0.1F);
}

TEST(Camera, LooksStraightUpAndDown) {
  for (const float z : {-1.0F, 1.0F}) {
    Camera camera;
    camera.direction = {0, 0, z};
    const Vec3 d = CameraRays(camera, 64, 64).ray({10, 20}, Vec2(0)).direction;
    EXPECT_TRUE(std::isfinite(d.x + d.y + d.z));
    EXPECT_GT(d.z * z, 0.7F);
  }
}

TEST(Camera, RaysThroughTheLensMeetInTheFocus) {
  Camera camera = oblique();
  camera.aperture = 0.4F;
  camera.focus = 25;
  const CameraRays rays(camera, 640, 360);
  const Vec3 forward = glm::normalize(camera.direction);
  const auto at_focus = [&](Vec2 lens) {
    const Ray ray = rays.ray({100, 300}, lens);
    EXPECT_LE(glm::distance(ray.origin, camera.position), 0.2001F);
    EXPECT_NEAR(glm::dot(ray.origin - camera.position, forward), 0, 1e-5F);
    const float t =
        (25 - glm::dot(ray.origin - camera.position, forward)) / glm::dot(ray.direction, forward);
    return ray.origin + t * ray.direction;
  };
  const Vec3 first = at_focus({0.5F, 0.5F});
  for (int k = 0; k < 50; ++k) EXPECT_LT(glm::distance(at_focus(random_pair(k, 2)), first), 1e-3F);
}

TEST(DiscSample, IsUniform) {
  // Rings of equal area times sectors.
  constexpr int rings = 4;
  constexpr int sectors = 8;
  constexpr int side = 400;
  std::array<int, rings * sectors> counts{};
  for (int k = 0; k < side * side; ++k) {
    const int row = k / side;
    const Vec2 u((static_cast<float>(k % side) + 0.5F) / side,
                 (static_cast<float>(row) + 0.5F) / side);
    const Vec2 d = disc_sample(u);
    const float r2 = glm::dot(d, d);
    ASSERT_LE(r2, 1.0F);
    const float turn = std::atan2(d.y, d.x) / (2 * pi) + 0.5F;
    const int sector = std::min(sectors - 1, static_cast<int>(turn * sectors));
    const int cell = static_cast<int>(r2 * rings) * sectors + sector;
    ++counts[static_cast<std::size_t>(cell)];
  }
  constexpr double expected = 5000;  // in each cell
  for (const int n : counts) EXPECT_NEAR(n, expected, 0.03 * expected);
}

}  // namespace
}  // namespace wold
