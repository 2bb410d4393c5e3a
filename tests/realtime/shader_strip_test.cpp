#include "realtime/shader_strip.hpp"

#include <gtest/gtest.h>

namespace wold {
namespace {

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

const char* const source = R"(// Heading

#define USED 2.0
#define UNUSED 3.0
uniform float kept;

// A table.
const float table[2] = float[2](1.0, USED);
const float idle[2] = float[2](1.0, 2.0);

struct Pair {
  float a;
  float b;
};
struct Lone {
  float a;
};

// Both overloads stay.
float twice(float x) {
  return 2.0 * x;  // not unused()
}
vec2 twice(vec2 x) {
  return 2.0 * x;
}

// Nobody calls this.
float unused(float x) {
  if (x > 0.0) { return other(x); }
  return x;
}
float other(float x) { return x; }

#if USED > 1.0
float chosen() { return table[0]; }
#else
float chosen() { return 0.0; }
#endif

void mainImage(out vec4 color, in vec2 pixel) {
  Pair p = Pair(twice(pixel.x), chosen());
  color = vec4(p.a);
}
)";

TEST(ShaderStrip, KeepsWhatTheRootReaches) {
  const std::string out = stripped_shader(source, "mainImage");
  for (const char* part :
       {"Heading", "#define USED", "uniform float kept", "const float table", "struct Pair",
        "float twice", "vec2 twice", "Both overloads", "float chosen() { return table",
        "float chosen() { return 0.0", "#else", "#endif", "void mainImage"})
    EXPECT_TRUE(has(out, part)) << part << "\n" << out;
}

TEST(ShaderStrip, DropsTheRestWithItsComments) {
  const std::string out = stripped_shader(source, "mainImage");
  for (const char* part : {"UNUSED", "idle", "Lone", "float unused", "Nobody", "float other"})
    EXPECT_FALSE(has(out, part)) << part << "\n" << out;
  EXPECT_EQ(stripped_shader(out, "mainImage"), out);  // nothing more to drop
}

TEST(ShaderStrip, DropsOverloadsThatNothingCalls) {
  const std::string out = stripped_shader(R"(
float sum(float a) { return a; }
float sum(float a, float b) { return a + b; }  // , not a third (argument
float sum(float a, float b, float c) {
  return sum(a,
             max(b, c));
}
float sum() { return 0.0; }
void mainImage(out vec4 color, in vec2 pixel) {
  color = vec4(sum(pixel.x, vec2(1.0, 2.0).x, table[int(max(1.0, 2.0))]));
}
)",
                                          "mainImage");
  EXPECT_TRUE(has(out, "sum(float a, float b)")) << out;
  EXPECT_TRUE(has(out, "sum(float a, float b, float c)")) << out;
  EXPECT_FALSE(has(out, "sum(float a) ")) << out;
  EXPECT_FALSE(has(out, "sum()")) << out;
}

}  // namespace
}  // namespace wold
