#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <iostream>
#include <optional>

#include "base/error.hpp"
#include "gpu/context.hpp"
#include "gpu/evaluate.hpp"
#include "gpu/objects.hpp"

namespace wold {
namespace {

TEST(Context, GivesTheHighestVersionAndFallsBack) {
  {
    const OffscreenContext context;
    const GpuInfo info = gpu_info();
    EXPECT_GE(info.major * 10 + info.minor, 33);
    EXPECT_FALSE(info.es);
    EXPECT_FALSE(info.renderer.empty());
  }
  const OffscreenContext impossible({.major = 9, .minor = 9});
  EXPECT_GE(gpu_info().major * 10 + gpu_info().minor, 33);
}

TEST(Context, GivesEs3) {
  const OffscreenContext context({.es = true});
  EXPECT_TRUE(gpu_info().es);
  EXPECT_EQ(gpu_info().dialect, ShaderDialect::es_300);
  const auto out = evaluate_shader("vec4 evaluate(vec4 a, vec4 b) { return a + 2.0 * b; }",
                                   std::array{Vec4(1)}, std::array{Vec4(2)});
  EXPECT_EQ(out[0], Vec4(5));
}

/// In a process of its own: Mesa looks at its environment once.
void ask_for_a_context_of_an_old_driver() {
  ::setenv("MESA_GL_VERSION_OVERRIDE", "3.0", 1);
  try {
    const OffscreenContext context;
    gpu_info();
  } catch (const Error& error) {
    std::cerr << error.message();
    std::exit(3);
  }
  std::exit(0);
}

TEST(ContextDeathTest, OfADriverThatIsTooOldSaysWhatHelps) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(ask_for_a_context_of_an_old_driver(), testing::ExitedWithCode(3),
              "OpenGL 3.3.*libgl1-mesa-dri");
}

class Gpu : public testing::Test {
 protected:
  OffscreenContext context_;
};

TEST_F(Gpu, EvaluatesEveryPointInItsPlace) {
  std::vector<Vec4> points;
  for (int k = 0; k < 3000; ++k) points.emplace_back(k, 1, 0, 0);
  const auto out = evaluate_shader("vec4 evaluate(vec4 a, vec4 b) { return a.xxxy * FACTOR; }",
                                   points, {}, std::array{ShaderDefine{"FACTOR", "2.0"}});
  for (int k = 0; k < 3000; ++k)
    ASSERT_EQ(out[static_cast<std::size_t>(k)], Vec4(2 * k, 2 * k, 2 * k, 2));
}

TEST_F(Gpu, AShaderThatFailsTellsFileAndLine) {
  try {
    evaluate_shader("\n\nvec4 evaluate(vec4 a, vec4 b) { return nonsense; }", std::array{Vec4(0)});
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(error.message().find("evaluate:4: error"), std::string::npos) << error.message();
    EXPECT_NE(error.message().find("nonsense"), std::string::npos);
  }
}

TEST_F(Gpu, TexturesKeepTheirRows) {
  Grid<float> values(3, 2);
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 3; ++i) values(i, j) = static_cast<float>(10 * j + i);
  const GpuTexture texture(values, {.format = PixelFormat::r32f, .filter = TextureFilter::nearest});
  const GpuTarget target(3, 2, std::array{PixelFormat::rgba32f}, false);
  const GpuProgram program(
      assemble_shader("gpu/full_screen.vert.glsl", gpu_info().dialect),
      assemble_shader_text("copy",
                           "uniform sampler2D source; in vec2 screen_place; out vec4 result;\n"
                           "void main() { result = texture(source, screen_place); }",
                           gpu_info().dialect));
  target.bind();
  program.use();
  program.set("source", 3);
  texture.bind(3);
  draw_full_screen();
  const std::vector<float> out = target.read();
  const std::array<float, 6> rows{0, 1, 2, 10, 11, 12};
  for (std::size_t k = 0; k < rows.size(); ++k) EXPECT_EQ(out[4 * k], rows[k]);
}

TEST_F(Gpu, ATextureBeyondTheDriverIsALimit) {
  try {
    const GpuTexture texture(1 << 20, 1 << 20, {});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::limit);
    EXPECT_NE(error.message().find("1048576"), std::string::npos);
    EXPECT_NE(error.message().find("at most"), std::string::npos);
  }
}

}  // namespace
}  // namespace wold
