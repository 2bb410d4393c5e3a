#include "raster/terrain_shade.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "gpu/context.hpp"
#include "gpu/evaluate.hpp"
#include "terrain_testing.hpp"

namespace wold {
namespace {

constexpr int samples = 257;
constexpr double cell = 10;
constexpr double half = 0.5 * cell * (samples - 1);  // m

/// A field about the origin of the heights that a function of place gives.
template <class Height>
Ground land(const Height& height) {
  Heightfield field{Grid<float>(samples, samples), DVec2(-half), cell};
  for (int j = 0; j < samples; ++j)
    for (int i = 0; i < samples; ++i)
      field.height(i, j) = static_cast<float>(height(field.origin + cell * DVec2(i, j)));
  return {std::move(field), {}, {}, 1};
}

Vec3 towards(float elevation, float azimuth) {  // degrees, azimuth from east to north
  const float e = radians(elevation);
  const float a = radians(azimuth);
  return {std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e)};
}

/// A wall of 100 m along x = 0.
Ground wall(bool along_y) {
  return land([=](DVec2 p) { return std::abs(along_y ? p.x : p.y) < 1 ? 100.0 : 0.0; });
}

/// Distance from the wall's foot at which the share of the sun on the plane reaches `share`, going
/// west (or south).
double shadow_end(const SunShadowMap& shadows, bool along_y, float share) {
  for (double x = 1.5 * cell; x < half; x += 0.25) {
    const Vec3 place = along_y ? Vec3(-x, 0, 0) : Vec3(0, -x, 0);
    if (shadows.share(place) >= share) return x;
  }
  return half;
}

TEST(SunShadowMap, AWallThrowsAShadowOfItsHeightOverTheTangent) {
  for (const bool along_y : {true, false}) {
    const Ground ground = wall(along_y);
    SunShadowMap shadows(ground);
    for (const float elevation : {12.0F, 30.0F, 50.0F})
      for (const float turn : {-30.0F, 0.0F, 20.0F, 60.0F}) {
        shadows.set_sun(towards(elevation, (along_y ? 0.0F : 90.0F) + turn));
        const double expected = 100 / std::tan(radians(static_cast<double>(elevation))) *
                                std::cos(radians(static_cast<double>(turn)));
        EXPECT_NEAR(shadow_end(shadows, along_y, 0.5F), expected, 0.25 * cell + 0.02 * expected)
            << elevation << " " << turn;
        EXPECT_EQ(shadows.share(Vec3(along_y ? Vec2(300, 0) : Vec2(0, 300), 0)), 1);
      }
  }
}

TEST(SunShadowMap, HalfShadowIsAsWideAsTheSun) {
  const Ground ground = wall(true);
  SunShadowMap shadows(ground);
  constexpr float radius = 0.03F;
  shadows.set_sun(towards(20, 0), radius);
  const double e = radians(20.0);
  const auto r = static_cast<double>(radius);
  EXPECT_NEAR(shadow_end(shadows, true, 0.01F), 100 / std::tan(e + r), 0.5 * cell);
  EXPECT_NEAR(shadow_end(shadows, true, 0.99F), 100 / std::tan(e - r), 0.5 * cell);
}

TEST(SunShadowMap, WhatRisesOutOfTheShadowIsLit) {
  const Ground ground = wall(true);
  SunShadowMap shadows(ground);
  shadows.set_sun(towards(30, 0));
  // 100 m from the wall its shadow is 100 - 100 tan 30° = 42 m high.
  EXPECT_EQ(shadows.share({-100, 0, 38}), 0);
  EXPECT_EQ(shadows.share({-100, 0, 47}), 1);
}

TEST(SunShadowMap, EvenSlopesAreLitUntilTheyTurnAway) {
  const Ground ground = land([](DVec2 p) { return 0.5 * p.x; });  // 26.6°, rising to the east
  SunShadowMap shadows(ground);
  const Vec3 middle(0, 0, 0);
  shadows.set_sun(towards(28, 0));
  EXPECT_EQ(shadows.share(middle), 1);
  shadows.set_sun(towards(25, 0));
  EXPECT_EQ(shadows.share(middle), 0);
  shadows.set_sun(towards(5, 180));
  EXPECT_EQ(shadows.share(middle), 1);
}

TEST(SunShadowMap, SurroundingsThrowShadowsOnTheField) {
  Heightfield field{Grid<float>(33, 33, 0.0F), {-160, -160}, 10};
  Heightfield around{Grid<float>(65, 65, 0.0F), {-1280, -1280}, 40};
  for (int j = 0; j < 65; ++j) around.height(42, j) = 300;  // x = 400
  const Ground ground(std::move(field), std::move(around), {}, 1);
  SunShadowMap shadows(ground);
  shadows.set_sun(towards(30, 0));  // reaches 520 m, to x = -120
  EXPECT_EQ(shadows.share({-100, 0, 0}), 0);
  EXPECT_EQ(shadows.share({-150, 0, 0}), 1);
}

// A lone pillar's shadow does not fade out over hundreds of samples.
TEST(SunShadowMap, NarrowShadowsStayDark) {
  const Ground ground =
      land([](DVec2 p) { return std::abs(p.x - 1000) < 1 && std::abs(p.y) < 11 ? 500.0 : 0.0; });
  SunShadowMap shadows(ground);
  for (const float turn : {0.0F, 10.0F, 30.0F}) {
    shadows.set_sun(towards(15, turn));
    const float far = 1500;
    const Vec2 away = -far * Vec2(std::cos(radians(turn)), std::sin(radians(turn)));
    EXPECT_LT(shadows.share(Vec3(Vec2(1000, 0) + away, 40)), 0.05) << turn;
  }
}

// Along the bottom of an endless valley with slopes α the mean of cos² of the horizon's elevation
// over all directions is that of 1 / (1 + tan² α sin² φ): cos α.
TEST(SkyVisibility, BottomOfAValley) {
  for (const double alpha : {15.0, 30.0, 45.0}) {
    const Ground ground = land([=](DVec2 p) { return std::abs(p.x) * std::tan(radians(alpha)); });
    EXPECT_NEAR(SkyVisibility(ground, 257).share({0, 0}), std::cos(radians(alpha)), 0.03) << alpha;
  }
}

// At the distance x from an endless wall of height h, half of the directions have a horizon of
// tan b = h |cos φ| / x: V = (1 + 1 / √(1 + (h / x)²)) / 2.
TEST(SkyVisibility, FarWall) {
  const Ground ground = land([](DVec2 p) { return p.x > 0 ? 200.0 : 0.0; });
  EXPECT_NEAR(SkyVisibility(ground, 129).share({-400, 0}), 0.5 * (1 + 1 / std::sqrt(1.25)), 0.02);
}

TEST(SkyVisibility, SlopesCrestsAndPlainsSeeAllTheirSky) {
  const Ground slope = land([](DVec2 p) { return 0.7 * p.x + 0.2 * p.y; });
  EXPECT_NEAR(SkyVisibility(slope, 65).share({100, 50}), 1, 0.01);
  const Ground crest = land([](DVec2 p) { return -std::abs(p.x); });
  EXPECT_NEAR(SkyVisibility(crest, 65).share({0, 0}), 1, 0.01);
  const Ground plain = land([](DVec2) { return 5.0; });
  EXPECT_NEAR(SkyVisibility(plain, 65).share({0, 0}), 1, 1e-4);
}

TEST(TerrainShade, ShaderSeesTheSame) {
  const OffscreenContext context;
  const Ground ground = testing::varied_ground();
  SunShadowMap shadows(ground);
  shadows.set_sun(towards(12, 200));
  const SkyVisibility visibility(ground, 65);
  TerrainShade shade;
  shade.set(shadows);
  shade.set(visibility);
  std::vector<Vec4> a;
  for (const DVec2& p : testing::places(3000, DVec2(0), 1400))
    a.emplace_back(Vec2(p), ground.base(p).height, 0);
  const std::vector<Vec4> got = evaluate_shader(R"(
#include "raster/terrain_shadow.glsl"
vec4 evaluate(vec4 a, vec4 b) {
  return vec4(terrain_sun_share(a.xyz), terrain_sky_share(a.xyz), 0.0, 0.0);
}
)",
                                                a, {}, {}, [&](const GpuProgram& program) {
                                                  program.use();
                                                  shade.apply(program, 3);
                                                });
  int lit = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    lit += got[k].x > 0.5F ? 1 : 0;
    EXPECT_NEAR(got[k].x, shadows.share(Vec3(a[k])), 2e-3);
    EXPECT_NEAR(got[k].y, visibility.share(DVec2(a[k].x, a[k].y)), 1e-4);
  }
  EXPECT_GT(lit, 500);
  EXPECT_LT(lit, 2800);
}

}  // namespace
}  // namespace wold
