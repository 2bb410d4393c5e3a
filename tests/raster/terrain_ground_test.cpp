// The ground's GLSL against its C++ twin.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "gpu/context.hpp"
#include "gpu/evaluate.hpp"
#include "raster/ground_textures.hpp"
#include "terrain_testing.hpp"

namespace wold {
namespace {

using testing::places;
using testing::varied_ground;

constexpr double world_half = 1270;  // m, half of the land of varied_ground

class TerrainGround : public ::testing::Test {
 protected:
  OffscreenContext context_;

  /// `body` at places, given in metres from the anchor; b.x is a footprint.
  static std::vector<Vec4> at(const Ground& ground, DVec2 anchor, const std::vector<DVec2>& where,
                              float footprint, const char* body) {
    GroundTextures textures(ground);
    textures.move_anchor(anchor);
    std::vector<Vec4> a;
    std::vector<Vec4> b(where.size(), Vec4(footprint, 0, 0, 0));
    for (const DVec2& p : where) a.emplace_back(Vec2(p - anchor), 0, 0);
    return evaluate_shader(body, a, b, {},
                           [&](const GpuProgram& program) { textures.apply(program); });
  }
};

constexpr const char* base_body = R"(
#include "render/ground_heights.glsl"
vec4 evaluate(vec4 a, vec4 b) { return vec4(ground_base(a.xy, ground_lift(a.xy)), 0.0); }
)";

constexpr const char* detailed_body = R"(
#include "render/ground_heights.glsl"
vec4 evaluate(vec4 a, vec4 b) { return vec4(ground_detailed(a.xy, ground_lift(a.xy), b.x), 0.0); }
)";

constexpr const char* color_body = R"(
#include "render/ground.glsl"
vec4 evaluate(vec4 a, vec4 b) {
  GroundSurface s = ground_surface(a.xy, ground_lift(a.xy), b.x);
  return vec4(s.reflectance, s.roughness);
}
)";

constexpr const char* normal_body = R"(
#include "render/ground.glsl"
vec4 evaluate(vec4 a, vec4 b) {
  GroundSurface s = ground_surface(a.xy, ground_lift(a.xy), b.x);
  return vec4(s.normal, s.height);
}
)";

/// The share of values that differ by more than `tolerance`: places where a step (a border, a
/// shore) falls between the two are few.
template <class Expected>
double share_beyond(const std::vector<Vec4>& got, const std::vector<DVec2>& where, float tolerance,
                    const Expected& expected) {
  int beyond = 0;
  for (std::size_t k = 0; k < got.size(); ++k) {
    const Vec4 e = expected(where[k]);
    float most = 0;
    for (int c = 0; c < 4; ++c) most = std::max(most, std::abs(got[k][c] - e[c]));
    if (!(most <= tolerance)) {
      if (beyond < 3)
        ADD_FAILURE_AT(__FILE__, __LINE__)
            << "at " << where[k].x << ", " << where[k].y << ": " << got[k].x << " " << got[k].y
            << " " << got[k].z << " " << got[k].w << " for " << e.x << " " << e.y << " " << e.z
            << " " << e.w;
      ++beyond;
    }
  }
  return static_cast<double>(beyond) / static_cast<double>(got.size());
}

TEST_F(TerrainGround, BaseHeightsEqual) {
  const Ground ground = varied_ground();
  // Beyond the borders too: the ground goes on at border height.
  const auto where = places(4000, DVec2(0), 1.1 * world_half);
  const auto got = at(ground, {37, -80}, where, 0, base_body);
  EXPECT_EQ(share_beyond(got, where, 2e-3F,
                         [&](DVec2 p) {
                           const GroundSample s = ground.base(p);
                           return Vec4(s.height, s.gradient, 0);
                         }),
            0);
}

TEST_F(TerrainGround, DetailedHeightsEqual) {
  const Ground ground = varied_ground();
  for (const float spacing : {0.05F, 1.0F, 5.0F}) {
    const auto where = places(4000, DVec2(0), world_half);
    const auto got = at(ground, {100, 300}, where, spacing, detailed_body);
    EXPECT_LE(share_beyond(got, where, 3e-3F,
                           [&](DVec2 p) {
                             const GroundSample s = ground.detailed(p, spacing);
                             return Vec4(s.height, s.gradient, 0);
                           }),
              0.001)
        << spacing;
  }
}

TEST_F(TerrainGround, DetailHoldsFarFromTheOrigin) {
  const DVec2 middle(98765.4, -54321.6);
  const Ground ground = varied_ground(middle);
  const DVec2 anchor = middle + DVec2(120, 90);
  const auto where = places(1000, anchor, 20);
  // As near to the eye as the float offsets from the anchor tell places apart.
  std::vector<DVec2> told;
  for (const DVec2& p : where) told.push_back(anchor + DVec2(Vec2(p - anchor)));
  const auto got = at(ground, anchor, where, 0.02F, detailed_body);
  EXPECT_EQ(share_beyond(got, told, 5e-3F,
                         [&](DVec2 p) {
                           const GroundSample s = ground.detailed(p, 0.02F);
                           return Vec4(s.height, s.gradient, 0);
                         }),
            0);
}

TEST_F(TerrainGround, SurfacesEqual) {
  const Ground ground = varied_ground();
  for (const float footprint : {0.02F, 0.5F, 8.0F}) {
    const auto where = places(3000, DVec2(0), world_half);
    const auto colors = at(ground, {0, 0}, where, footprint, color_body);
    EXPECT_LE(share_beyond(colors, where, 2e-3F,
                           [&](DVec2 p) {
                             const GroundSurface s = ground.surface(p, footprint);
                             return Vec4(s.reflectance, s.roughness);
                           }),
              0.002)
        << footprint;
    const auto normals = at(ground, {0, 0}, where, footprint, normal_body);
    EXPECT_LE(share_beyond(normals, where, 5e-3F,
                           [&](DVec2 p) {
                             const GroundSurface s = ground.surface(p, footprint);
                             return Vec4(s.normal,
                                         ground.detailed(p, std::max(footprint, 0.004F)).height);
                           }),
              0.002)
        << footprint;
  }
}

TEST_F(TerrainGround, GroundWithoutSurroundings) {
  const Ground ground(testing::hills(33, 10, {500, 500}, 80), {}, {}, 3);
  const auto where = places(1000, {500, 500}, 155);
  const auto got = at(ground, {480, 500}, where, 0.3F, color_body);
  EXPECT_LE(share_beyond(got, where, 2e-3F,
                         [&](DVec2 p) {
                           const GroundSurface s = ground.surface(p, 0.3F);
                           return Vec4(s.reflectance, s.roughness);
                         }),
            0.002);
}

}  // namespace
}  // namespace wold
