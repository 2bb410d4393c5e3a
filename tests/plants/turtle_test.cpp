#include "plants/turtle.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "plants/plant.hpp"

namespace wold {
namespace {

Skeleton drawn(const std::string& word, const std::string& settings = "angle 90\n") {
  const Plant plant = parse_plant(settings + "axiom: " + word + "\n", "test.lsys");
  Progress progress;
  return draw(derive(plant.system, 0, 0, {}, progress), plant.turtle);
}

Vec3 end_of(const std::string& word, const std::string& settings = "angle 90\n") {
  return drawn(word, settings).axes.front().nodes.back().position;
}

void expect_near(Vec3 a, Vec3 b, float tolerance = 1e-5F) {
  EXPECT_LT(glm::distance(a, b), tolerance)
      << a.x << ' ' << a.y << ' ' << a.z << " is not " << b.x << ' ' << b.y << ' ' << b.z;
}

TEST(Turtle, ASquareReturns) {
  const Skeleton s = drawn("F+F+F+F");
  ASSERT_EQ(s.axes.size(), 1U);
  EXPECT_EQ(s.axes[0].nodes.size(), 5U);
  expect_near(s.axes[0].nodes[0].position, s.axes[0].nodes[4].position);
  expect_near(end_of("F&F&F&F"), Vec3(0));
  expect_near(end_of("F-(60)-(60)F-(120)F"), Vec3(0));
}

TEST(Turtle, TurnsAsInTheBook) {
  // Up is +Z, left is -X (west, for one who looks north), the turtle's back faces south.
  expect_near(end_of("F(2)+F"), Vec3(-1, 0, 2));
  expect_near(end_of("F(2)-F"), Vec3(1, 0, 2));
  expect_near(end_of("F(2)&F"), Vec3(0, 1, 2));
  expect_near(end_of("F(2)^F"), Vec3(0, -1, 2));
  expect_near(end_of("F|F(3)"), Vec3(0, 0, -2));
  // Rolled left, the left side points down (to +Y here); rolled right, up.
  expect_near(end_of("\\+F"), Vec3(0, 1, 0));
  expect_near(end_of("/+F"), Vec3(0, -1, 0));
  expect_near(end_of("F(3)", "step 5\n"), Vec3(0, 0, 3));
  expect_near(end_of("F", "step 5\n"), Vec3(0, 0, 5));
}

TEST(Turtle, DollarMakesLeftHorizontal) {
  // From any attitude: after $, turns by + and - stay in a vertical plane's normal direction.
  const Skeleton s = drawn("+(37)&(21)/(50)$F[+(90)F][-(90)F]");
  const Vec3 corner = s.axes[0].nodes[1].position;
  for (const int k : {1, 2})
    EXPECT_NEAR(s.axes[static_cast<std::size_t>(k)].nodes[1].position.z, corner.z, 1e-5);
}

TEST(Turtle, BracketsRestoreTheState) {
  const Skeleton s = drawn("F[+F'!(3)F]F");
  ASSERT_EQ(s.axes.size(), 3U);
  EXPECT_EQ(s.axes[0].nodes.size(), 3U);
  EXPECT_EQ(s.axes[1].parent, 0);
  EXPECT_EQ(s.axes[1].parent_node, 1);
  // A change of colour begins an axis.
  EXPECT_EQ(s.axes[2].parent, 1);
  EXPECT_EQ(s.axes[2].colour, 1);
  EXPECT_EQ(s.axes[0].colour, 0);
  EXPECT_EQ(s.axes[2].nodes[1].radius, 3);
  EXPECT_NE(s.axes[0].nodes[2].radius, 3);
}

TEST(Turtle, DrawsPolygons) {
  const Skeleton s = drawn("{.f+f+f+f}");
  ASSERT_EQ(s.polygons.size(), 1U);
  EXPECT_EQ(s.polygons[0].vertices.size(), 5U);
  EXPECT_TRUE(s.axes.empty());
  const Skeleton nested = drawn("{.G.+G.{.f.f+f}+G.}");
  ASSERT_EQ(nested.polygons.size(), 2U);
  EXPECT_EQ(nested.polygons[1].vertices.size(), 4U);
}

TEST(Turtle, PlacesOrgans) {
  const Skeleton s = drawn("F(2)+~L(0.5)");
  ASSERT_EQ(s.organs.size(), 1U);
  EXPECT_EQ(s.organs[0].name, 'L');
  EXPECT_EQ(s.organs[0].size, 0.5F);
  expect_near(s.organs[0].position, Vec3(0, 0, 2));
  expect_near(s.organs[0].heading, Vec3(-1, 0, 0));
  expect_near(s.organs[0].up, Vec3(0, -1, 0));
}

// Turning by e |H × T| from the angle φ0 to the tropism: tan(φ/2) falls by about exp(-e) a step,
// and never passes the tropism.
TEST(Turtle, BendsTowardsTheTropism) {
  const std::string settings = "bending 0.1\ntropism 0, 0, -1\n";
  std::string word = "+(90)";
  for (int k = 0; k < 60; ++k) word += "F(1)";
  const Skeleton s = drawn(word, settings);
  const auto& nodes = s.axes[0].nodes;
  float last = 2;
  for (std::size_t k = 1; k < nodes.size(); ++k) {
    const Vec3 h = nodes[k].position - nodes[k - 1].position;
    EXPECT_LE(h.z, last);
    last = h.z;
  }
  EXPECT_NEAR(last, -1, 1e-3);
  const Vec3 second = nodes[2].position - nodes[1].position;
  EXPECT_NEAR(second.z, -std::sin(0.1F), 1e-5);
  expect_near(drawn("@t(0)F(5)", settings).axes[0].nodes[1].position, Vec3(0, 0, 5));
}

TEST(Turtle, SkipsWhatIsCut) {
  const Skeleton s = drawn("F[+F%F[F]F]F");
  EXPECT_EQ(s.axes.size(), 2U);
  EXPECT_EQ(s.axes[1].nodes.size(), 2U);
}

TEST(Turtle, IgnoresUnknownModules) {
  expect_near(end_of("A(3)FB@x(2)F"), Vec3(0, 0, 2));
}

TEST(Turtle, RefusesNonsense) {
  EXPECT_THROW(drawn("F(1/0)"), Error);
  EXPECT_THROW(drawn("F."), Error);
}

}  // namespace
}  // namespace wold
