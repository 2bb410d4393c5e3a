#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/hash.hpp"
#include "gpu/context.hpp"
#include "gpu/evaluate.hpp"
#include "realtime/fast_passes.hpp"
#include "scene/scene.hpp"

namespace wold {
namespace {

std::size_t texel_at(int row, int width, int column) {
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
         static_cast<std::size_t>(column);
}

constexpr int size = 64;
constexpr int levels = 3;
constexpr int halvings = 5;
constexpr double cell = 20;

/// The land of a scene baked in small squares, moved once so that they wrap.
class FastMarch : public testing::Test {
 protected:
  FastMarch() {
    const Scene scene = parse_scene(
        "[terrain]\nsize = 4000\nresolution = 65\n[[terrain.step]]\nop = \"ridged\"\n"
        "height = 700\nfeature_size = 1500\noctaves = 5\n",
        "test.toml", {});
    Progress progress;
    landscape_ = landscape_of(scene, {}, progress);
    FastPasses passes(landscape_);
    const RingTarget target;
    for (const DVec2 eye : {DVec2(0), eye_})
      bake_land(passes, target, squares_, squares_.move_to(eye), heights_, maxima_,
                [&](const GpuProgram& program) { bind(program); });
  }

  void bind(const GpuProgram& program) const {
    program.use();
    heights_.bind(0);
    maxima_.bind(1);
    program.set("ring_heights", 0);
    program.set("ring_maxima", 1);
    program.set("ring_size", size);
    program.set("ring_levels", levels);
    program.set("ring_cell", static_cast<float>(cell));
    program.set("ring_eye", Vec2(eye_));
    program.set("iTime", 0.0F);
    // Samplers of other kinds may not share a unit.
    for (const char* name :
         {"frame_view", "last_view", "air_transmittances", "air_multiples", "sky_by_air",
          "sky_by_aerosol", "sky_passed", "land_picture", "new_picture", "history"})
      program.set(name, 2);
  }

  std::vector<Vec4> evaluated(const std::string& function, const std::vector<Vec4>& a,
                              const std::vector<Vec4>& b = {}) const {
    return evaluate_shader(fast_pass_functions(landscape_body(landscape_)) + function, a, b, {},
                           [&](const GpuProgram& program) { bind(program); });
  }

  std::vector<float> maxima(int level) const {
    const int n = size >> level;
    std::vector<float> values(texel_at(n * levels, n, 0));
    glBindTexture(GL_TEXTURE_2D_ARRAY, maxima_.id());
    glGetTexImage(GL_TEXTURE_2D_ARRAY, level, GL_RED, GL_FLOAT, values.data());
    return values;
  }

  OffscreenContext context_;
  DVec2 eye_{330, -470};
  RingSquares squares_{size, levels, cell};
  GpuTexture heights_{
      size, size, {.format = PixelFormat::rgba32f, .repeat = true, .layers = levels}};
  GpuTexture maxima_{size,
                     size,
                     {.format = PixelFormat::r32f,
                      .filter = TextureFilter::nearest,
                      .repeat = true,
                      .layers = levels,
                      .levels = halvings}};
  Landscape landscape_;
};

TEST_F(FastMarch, EachMaximumIsThatOfItsChildren) {
  for (int level = 1; level < halvings; ++level) {
    const std::vector<float> fine = maxima(level - 1);
    const std::vector<float> coarse = maxima(level);
    const int n = size >> level;
    for (int layer = 0; layer < levels; ++layer)
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
          const auto child = [&](int di, int dj) {
            return fine[texel_at(layer * 2 * n + 2 * j + dj, 2 * n, 2 * i + di)];
          };
          ASSERT_EQ(coarse[texel_at(layer * n + j, n, i)],
                    std::max({child(0, 0), child(1, 0), child(0, 1), child(1, 1)}));
        }
  }
}

TEST_F(FastMarch, PatchesLieBelowTheirMaximum) {
  std::vector<Vec4> places;
  for (std::uint64_t k = 0; k < 4000; ++k)
    places.emplace_back(eye_.x + 1000 * (uniform(random_bits(1, k)) - 0.5),
                        eye_.y + 1000 * (uniform(random_bits(2, k)) - 0.5), 0, 0);
  const std::vector<Vec4> found = evaluated(
      "vec4 evaluate(vec4 a, vec4 b) {\n"
      "  ivec2 texel = ivec2(floor(a.xy / ring_cell)) & (ring_size - 1);\n"
      "  float most = texelFetch(ring_maxima, ivec3(texel, 0), 0).r;\n"
      "  vec3 patch_here = ring_patch(a.xy, 0);\n"
      "  return vec4(most, patch_here.x, ring_patch(a.xy + vec2(0.5, 0.0), 0).x, patch_here.y);\n"
      "}",
      places);
  for (const Vec4& f : found) {
    EXPECT_LE(f.y, f.x + 1e-3F);
    EXPECT_NEAR(f.z - f.y, 0.5F * f.w, 0.25F);  // and its derivative is one
  }
}

TEST_F(FastMarch, NoRayMissesTheLand) {
  std::vector<Vec4> starts;
  std::vector<Vec4> directions;
  for (std::uint64_t k = 0; k < 1500; ++k) {
    starts.emplace_back(eye_.x + 20 * (uniform(random_bits(3, k)) - 0.5), eye_.y,
                        720 + 100 * uniform(random_bits(4, k)), 0);
    const double turn = 2 * pi_d * uniform(random_bits(5, k));
    const double down = 0.02 + 0.6 * uniform(random_bits(6, k));
    directions.emplace_back(std::cos(down) * std::cos(turn), std::cos(down) * std::sin(turn),
                            -std::sin(down), 0);
  }
  const std::vector<Vec4> found = evaluated(
      "vec4 evaluate(vec4 a, vec4 b) {\n"
      "  LandRay ray = LandRay(a.xy, a.z, b.xyz);\n"
      "  float t = march_rings(ray, 0.5, 1900.0);\n"
      "  float plain = 0.5;\n"
      "  for (int k = ZERO; k < 950 && plain < 1900.0; ++k) {\n"
      "    vec2 place = place_along(ray, plain);\n"
      "    int level = level_reaching(away_from_eye(place));\n"
      "    if (height_along(ray, plain) < baked_height(place, ring_cell * exp2(float(level)), "
      "level)) break;\n"
      "    plain += 2.0;\n"
      "  }\n"
      "  return vec4(t, plain, 0.0, 0.0);\n"
      "}",
      starts, directions);
  int hits = 0;
  for (const Vec4& f : found) {
    if (f.y >= 1900) continue;
    ++hits;
    EXPECT_GT(f.x, 0);
    EXPECT_LT(f.x, f.y + 2);
  }
  EXPECT_GT(hits, 500);
}

}  // namespace
}  // namespace wold
