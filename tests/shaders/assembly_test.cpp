#include "shaders/assembly.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/error.hpp"
#include "shaders/library.hpp"

namespace wold {
namespace {

TEST(Shaders, FilesAreFoundByPathAndSorted) {
  ASSERT_FALSE(shader_files().empty());
  EXPECT_TRUE(std::is_sorted(shader_files().begin(), shader_files().end(),
                             [](const auto& a, const auto& b) { return a.path < b.path; }));
  EXPECT_NE(shader_file("gpu/full_screen.vert.glsl").find("gl_Position"), std::string_view::npos);
}

TEST(Shaders, AnUnknownFileIsToldWithTheNearestAndWhereItIsAskedFor) {
  try {
    assemble_shader_text("scene.frag", "void a() {}\n#include \"gpu/full_screen.vert.glls\"\n",
                         ShaderDialect::gl_330);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(error.message().find("Did you mean 'gpu/full_screen.vert.glsl'?"), std::string::npos);
    EXPECT_EQ(error.location().text(), "scene.frag:2");
  }
}

TEST(Shaders, EachFileStandsOnceAndLinesAreCounted) {
  const ShaderText shader = assemble_shader_text(
      "main", "#include \"noise/noise.glsl\"\n#include \"noise/lattice.glsl\"\nvoid main() {}\n",
      ShaderDialect::gl_330, std::vector<ShaderDefine>{{"STEPS", "3"}});
  EXPECT_TRUE(shader.text.starts_with("#version 330 core\n#define STEPS 3\n"));
  EXPECT_EQ(shader.files,
            (std::vector<std::string>{"main", "noise/noise.glsl", "noise/lattice.glsl"}));
  const std::string function = "uint lattice_key(uint";
  const auto first = shader.text.find(function);
  ASSERT_NE(first, std::string::npos);
  EXPECT_EQ(shader.text.find(function, first + 1), std::string::npos);
  EXPECT_NE(shader.text.find("#line 3 0\nvoid main() {}"), std::string::npos);
}

TEST(Shaders, LogsOfEveryDriverAreToldInOurNames) {
  const ShaderText shader{"main", "", {"main", "noise/lattice.glsl"}};
  EXPECT_EQ(readable_shader_log("1:12(5): error: `x' undeclared\n", shader),
            "noise/lattice.glsl:12: error: `x' undeclared");
  EXPECT_EQ(readable_shader_log("1(12) : error C1008: undefined variable", shader),
            "noise/lattice.glsl:12: error C1008: undefined variable");
  EXPECT_EQ(readable_shader_log("ERROR: 0:7: 'x' : undeclared identifier\n\n", shader),
            "main:7: 'x' : undeclared identifier");
  EXPECT_EQ(readable_shader_log("something else", shader), "something else");
}

TEST(Shaders, ExportHasNeitherVersionNorLines) {
  const std::string text = flatten_shader("#include \"raster/view.glsl\"\nvoid main() {}\n");
  EXPECT_EQ(text.find("#line"), std::string::npos);
  EXPECT_EQ(text.find("#include"), std::string::npos);
  EXPECT_NE(text.find("uniform vec3 eye"), std::string::npos);
}

}  // namespace
}  // namespace wold
