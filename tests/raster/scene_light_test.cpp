#include "raster/scene_light.hpp"

#include <gtest/gtest.h>

#include <array>

#include "gpu/context.hpp"
#include "gpu/evaluate.hpp"

namespace wold {
namespace {

/// ∫ L max(0, n·d) dω by many directions.
Vec3 irradiance_by_quadrature(const Sky& sky, Vec3 n) {
  constexpr int rows = 400;
  constexpr int columns = 400;
  DVec3 sum(0);
  for (int j = 0; j < rows; ++j) {
    const double z = 2 * (j + 0.5) / rows - 1;
    for (int i = 0; i < columns; ++i) {
      const double turn = 2 * pi_d * (i + 0.5) / columns;
      const Vec3 d(
          DVec3(std::sqrt(1 - z * z) * std::cos(turn), std::sqrt(1 - z * z) * std::sin(turn), z));
      sum += static_cast<double>(std::max(0.0F, glm::dot(n, d))) * DVec3(sky.radiance(d));
    }
  }
  return Vec3(sum * (4 * pi_d / (rows * columns)));
}

TEST(SkyHarmonics, AreNearTheIntegralInEveryDirection) {
  const Sky sky;
  const std::array<Vec3, 9> h = sky_harmonics(sky);
  const auto at = [&](Vec3 n) {
    return h[0] + h[1] * n.y + h[2] * n.z + h[3] * n.x + h[4] * (n.x * n.y) + h[5] * (n.y * n.z) +
           h[6] * (3 * n.z * n.z - 1) + h[7] * (n.x * n.z) + h[8] * (n.x * n.x - n.y * n.y);
  };
  for (const Vec3 n :
       {Vec3(0, 0, 1), Vec3(1, 0, 0), Vec3(0, -1, 0), Vec3(0.6F, 0, 0.8F), Vec3(0, 0, -1)}) {
    const Vec3 exact = irradiance_by_quadrature(sky, n);
    // Nine harmonics leave out less than 3 % of what a cosine lobe sees (Ramamoorthi, Hanrahan).
    EXPECT_LT(glm::length(at(n) - exact), 0.03F * glm::length(exact) + 0.01F * glm::length(h[0]));
  }
}

TEST(RadianceBelow, IsTheMeanByCosine) {
  for (const SkyModel model : {SkyModel::preetham, SkyModel::atmosphere}) {
    SkySettings settings;
    settings.model = model;
    const Sky sky(settings);
    const Vec3 exact = irradiance_by_quadrature(sky, {0, 0, -1});
    EXPECT_LT(glm::length(pi * radiance_below(sky) - exact), 0.01F * glm::length(exact));
  }
}

class LightOnTheGpu : public testing::Test {
 protected:
  OffscreenContext context_;
};

TEST_F(LightOnTheGpu, TheSkysTextureIsTheSky) {
  const Sky sky;
  const SceneLight light(sky, {.size = 0});
  const GpuProgram program(assemble_shader("gpu/full_screen.vert.glsl", gpu_info().dialect),
                           assemble_shader_text("sky", R"(
#include "raster/light.glsl"
in vec2 screen_place;
out vec4 result;
void main() {
  float z = 2.0 * screen_place.y - 1.0;
  float turn = 6.2831853 * screen_place.x;
  result = vec4(sky_radiance(vec3(sqrt(1.0 - z * z) * vec2(cos(turn), sin(turn)), z)), 1.0);
}
)",
                                                gpu_info().dialect));
  constexpr int size = 64;
  const GpuTarget target(size, size, std::array{PixelFormat::rgba32f}, false);
  target.bind();
  light.apply(program);
  draw_full_screen();
  const std::vector<float> out = target.read();
  for (int j = 0; j < size; ++j)
    for (int i = 0; i < size; ++i) {
      const float z = 2 * (static_cast<float>(j) + 0.5F) / size - 1;
      const float turn = 6.2831853F * (static_cast<float>(i) + 0.5F) / size;
      const float across = std::sqrt(1 - z * z);
      const Vec3 expected = sky.radiance({across * std::cos(turn), across * std::sin(turn), z});
      const std::size_t k = 4 * static_cast<std::size_t>(j * size + i);
      const Vec3 found(out[k], out[k + 1], out[k + 2]);
      // Texture filters have weights of 8 bits.
      ASSERT_LT(glm::length(found - expected), 5e-3F * glm::length(expected)) << i << ' ' << j;
    }
}

TEST_F(LightOnTheGpu, LeavesThatLookDownAreLitByTheLandThatIsThere) {
  const Sky sky;
  SceneLight light(sky, {.size = 0});
  const Vec3 reflectance(0.1F, 0.3F, 0.05F);
  light.set_land_colors({Grid<Vec3>(2, 2, reflectance), Vec4(0)});
  // Up, down.
  const std::vector<Vec4> got = evaluate_shader(R"(
#include "raster/plant_light.glsl"
vec4 evaluate(vec4 a, vec4 b) {
  return vec4(crown_ambient(vec3(0.0), a.xyz, vec4(0.0, 0.0, 0.0, 1.0), vec3(0.0)), 1.0);
}
)",
                                                std::array{Vec4(0, 0, 1, 0), Vec4(0, 0, -1, 0)}, {},
                                                {}, [&](const GpuProgram& program) {
                                                  program.use();
                                                  light.apply(program);
                                                });
  const Vec3 from_above = sky.sky_irradiance();
  const Vec3 on_land = from_above + sky.sun_direction().z * sky.sun_irradiance();
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(got[0][c], from_above[c], 0.05F * from_above[c]) << c;
    EXPECT_NEAR(got[1][c], reflectance[c] * on_land[c],
                0.05F * reflectance[c] * on_land[c] + 0.02F * from_above[c])
        << c;
  }
}

TEST_F(LightOnTheGpu, SmallPlantsLetThroughMoreThePalerTheirLeaves) {
  const Sky sky;
  SceneLight light(sky, {.size = 0});
  // Two layers of leaves that scatter nothing, a part, and all.
  constexpr float leaves = 2;
  CanopyShade undergrowth{
      1, 1, {leaves, 0, 0.36F * leaves, leaves}, Vec4(0.01F, 0.01F, 0.5F, 0.5F)};
  light.set_undergrowth(undergrowth);
  const std::vector<Vec4> got = evaluate_shader(R"(
#include "raster/light.glsl"
vec4 evaluate(vec4 a, vec4 b) {
  Undergrowth plants = undergrowth_at(vec3(0.0));
  return vec4(a.x > 0.0 ? sky_through(plants) : sun_scattered_by(plants), 1.0);
}
)",
                                                std::array{Vec4(1, 0, 0, 0), Vec4(-1, 0, 0, 0)}, {},
                                                {}, [&](const GpuProgram& program) {
                                                  program.use();
                                                  light.apply(program);
                                                });
  const float black = 0.5F * leaves / sky.sun_direction().z;
  const Vec3 paler(1, 0.8F, 0);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(got[0][c], std::exp(-0.8F * leaves * paler[c]), 1e-3F) << c;
    EXPECT_NEAR(got[1][c], std::exp(-black * paler[c]) - std::exp(-black), 1e-3F) << c;
  }
}

TEST_F(LightOnTheGpu, TheLandIsInTheFinerShadowMapsAlone) {
  ShadowMaps maps({.size = 16});
  std::vector<bool> without_land;
  maps.update(DrawView(), {0, 0, 1},
              [&](const DrawView& view) { without_land.push_back(view.without_land); });
  EXPECT_EQ(without_land, (std::vector<bool>{false, false, true, true}));
}

}  // namespace
}  // namespace wold
