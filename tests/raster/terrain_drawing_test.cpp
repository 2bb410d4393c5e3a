#include "raster/terrain_drawing.hpp"

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "gpu/context.hpp"
#include "terrain_testing.hpp"

namespace wold {
namespace {

using testing::varied_ground;

constexpr int width = 160;
constexpr int height = 90;

Camera camera_at(const Ground& ground, DVec2 place, float above, Vec3 direction) {
  Camera camera;
  camera.position = Vec3(Vec2(place), ground.detailed(place, 0.1F).height + above);
  camera.direction = glm::normalize(direction);
  return camera;
}

std::vector<Camera> cameras(const Ground& ground) {
  return {camera_at(ground, {50, 60}, 1.7F, {1, 0.3F, 0}),
          camera_at(ground, {-200, 100}, 1.7F, {-1, -0.5F, 0.05F}),
          camera_at(ground, {0, 0}, 100, {0.3F, 1, -0.4F}),
          camera_at(ground, {300, -310}, 20, {-1, 1, -0.1F}),
          camera_at(ground, {-1100, -1000}, 60, {1, 1, -0.1F}),
          camera_at(ground, {0, 0}, 2000, {0, 0.1F, -1})};
}

/// The height of the drawn ground along a ray that marches over it: the first distance where the
/// ray is below, m; negative where it never is.
float ground_hit(const Ground& ground, const Ray& ray, float pixel_angle) {
  const auto above = [&](float t) {
    const Vec3 p = ray.origin + t * ray.direction;
    return p.z - ground.detailed(DVec2(p.x, p.y), 2 * pixel_angle * t).height;
  };
  float t = 0.05F;
  while (t < 9000) {
    const Vec3 p = ray.origin + t * ray.direction;
    const bool outside = p.x < ground.low().x || p.y < ground.low().y || p.x > ground.high().x ||
                         p.y > ground.high().y;
    if (outside && t > 50) return -1;
    const float h = above(t);
    if (h <= 0) return t;
    t += std::max(0.15F * h, 0.3F * pixel_angle * t);
  }
  return -1;
}

class TerrainPicture : public ::testing::Test {
 protected:
  OffscreenContext context_;
  GpuTarget target_{width, height, std::array{PixelFormat::rgba32f}, true};
  SceneLight light_{Sky(), {.size = 0}};

  /// Row by row from the bottom; magenta where nothing is drawn.
  std::vector<float> picture(TerrainDrawing& terrain, const DrawView& view) {
    target_.bind();
    use_reversed_depth();
    glEnable(GL_DEPTH_TEST);
    glDisable(GL_BLEND);
    glClearColor(1e9F, 0, 1e9F, 0);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    terrain.draw(view, &light_);
    return target_.read();
  }

  static bool drawn(const std::vector<float>& pixels, int column, int row) {
    const std::size_t at =
        4 * (static_cast<std::size_t>(row) * width + static_cast<std::size_t>(column));
    return pixels[at + 3] > 0.5F;
  }
};

// What the path tracer's rays hit is drawn, what they miss is not, but for pixels on a silhouette.
TEST_F(TerrainPicture, CoversWhatRaysHit) {
  const Ground ground = varied_ground();
  TerrainDrawing terrain(ground, {.pixels_per_vertex = 3});
  for (const Camera& camera : cameras(ground)) {
    const auto pixels = picture(terrain, camera_view(camera, width, height));
    const CameraRays rays(camera, width, height);
    int unlike = 0;
    int holes = 0;
    for (int column = 0; column < width; column += 4)
      for (int row = 0; row < height; row += 2) {
        const Vec2 pixel(static_cast<float>(column) + 0.5F,
                         static_cast<float>(height - 1 - row) + 0.5F);
        const bool hit = ground_hit(ground, rays.ray(pixel, Vec2(0.5F)), rays.pixel_angle()) > 0;
        const bool is = drawn(pixels, column, row);
        unlike += hit != is ? 1 : 0;
        // Well inside: all around is drawn.
        bool around = true;
        for (int k = 1; k <= 2; ++k)
          around = around && row + k < height && drawn(pixels, column, row + k) && row >= k &&
                   drawn(pixels, column, row - k);
        holes += !is && around ? 1 : 0;
      }
    EXPECT_EQ(holes, 0);
    EXPECT_LE(unlike, 40 * 45 / 100) << camera.position.x << " " << camera.position.z;
  }
}

/// The highest drawn row of each column.
TEST_F(TerrainPicture, HorizonIsThatOfRays) {
  const Ground ground = varied_ground();
  TerrainDrawing terrain(ground, {.pixels_per_vertex = 3});
  for (std::size_t k : {0U, 1U, 3U}) {
    const Camera camera = cameras(ground)[k];
    const auto pixels = picture(terrain, camera_view(camera, width, height));
    const CameraRays rays(camera, width, height);
    int beyond = 0;
    for (int column = 0; column < width; column += 4) {
      int top = height - 1;
      while (top >= 0 && !drawn(pixels, column, top)) --top;
      int expected = height - 1;
      for (; expected >= 0; --expected) {
        const Vec2 pixel(static_cast<float>(column) + 0.5F,
                         static_cast<float>(height - 1 - expected) + 0.5F);
        if (ground_hit(ground, rays.ray(pixel, Vec2(0.5F)), rays.pixel_angle()) > 0) break;
      }
      beyond += std::abs(top - expected) > 1 ? 1 : 0;
    }
    EXPECT_LE(beyond, 1) << k;
  }
}

// A short step of the eye changes no pixel much: nothing pops.
TEST_F(TerrainPicture, FlightHasNoPops) {
  GroundMaterial material;
  material.detail = 0;
  material.distant_forest = 0;
  const Ground ground = varied_ground({0, 0}, &material);
  TerrainDrawing terrain(ground);
  const auto silhouette = [&](const Camera& camera) {
    const auto pixels = picture(terrain, camera_view(camera, width, height));
    std::vector<int> tops;
    for (int column = 0; column < width; ++column) {
      int top = height - 1;
      while (top >= 0 && !drawn(pixels, column, top)) --top;
      tops.push_back(top);
    }
    return tops;
  };
  Camera camera = cameras(ground)[3];
  std::vector<int> before = silhouette(camera);
  for (int k = 0; k < 40; ++k) {
    camera.position += Vec3(-0.2F, 0.2F, 0.02F);
    const std::vector<int> now = silhouette(camera);
    for (std::size_t c = 0; c < now.size(); ++c) EXPECT_LE(std::abs(now[c] - before[c]), 1);
    before = now;
  }
}

TEST_F(TerrainPicture, UpdateBringsOtherHeights) {
  const Ground hilly = varied_ground();
  Heightfield flat{Grid<float>(33, 33, 0.0F), {-400, -400}, 25};
  const Ground plane(std::move(flat), {}, {}, 1);
  Camera camera;
  camera.position = {0, 0, 20};
  camera.direction = {0, 1, 0};
  TerrainDrawing terrain(hilly);
  terrain.update(plane);
  const auto pixels = picture(terrain, camera_view(camera, width, height));
  // The plain ends 400 m away, 20 m below the eye.
  const float slope = 20.0F / 400;
  const float rows = slope / camera_view(camera, width, height).pixel_angle;
  const int edge = height / 2 - static_cast<int>(rows);
  EXPECT_TRUE(drawn(pixels, width / 2, edge - 2));
  EXPECT_FALSE(drawn(pixels, width / 2, edge + 2));
}

TEST_F(TerrainPicture, ShadowMapsNeedNoLight) {
  const Ground ground = varied_ground();
  TerrainDrawing terrain(ground);
  const DrawView camera = camera_view(cameras(ground)[0], width, height);
  const DrawView view =
      shadow_view(camera, camera.eye, glm::normalize(Vec3(0.3F, 0.2F, 1)), Vec3(200, 200, 800));
  target_.bind();
  use_reversed_depth();
  glEnable(GL_DEPTH_TEST);
  glClearColor(0, 0, 0, 0);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  terrain.draw(view, nullptr);
  EXPECT_GT(terrain.drawn_triangles(), 0U);
}

}  // namespace
}  // namespace wold
