#include <gtest/gtest.h>

#include <string>

#include "plants/plant.hpp"

namespace wold {
namespace {

std::string message(const std::string& text) {
  try {
    parse_plant(text, "x.lsys");
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(PlantParser, ReadsSettings) {
  const Plant p = parse_plant(
      "// a comment\n"
      "iterations 7     // and another\n"
      "angle 45/2\n"
      "height = 3.5\n"
      "tropism 0, 0.6, -0.8\n"
      "bending_per_metre true\n"
      "colours bark twig\n"
      "organ L length 0.05 width 0.6\n"
      "  bend 20 material needle\n"
      "material bark reflectance 0.5, 0.4, 0.3 roughness 0.2\n"
      "#define r1 0.9\n"
      "axiom: F(r1)\n",
      "x.lsys");
  EXPECT_EQ(p.iterations, 7);
  EXPECT_EQ(p.turtle.angle, 22.5F);
  EXPECT_EQ(p.height, 3.5F);
  EXPECT_EQ(p.turtle.tropism, Vec3(0, 0.6F, -0.8F));
  EXPECT_TRUE(p.turtle.tropism_per_metre);
  EXPECT_EQ(p.geometry.colours, (std::vector<std::string>{"bark", "twig"}));
  ASSERT_EQ(p.organs.size(), 1U);
  EXPECT_EQ(p.organs[0].name, 'L');
  EXPECT_EQ(p.organs[0].bend, 20);
  EXPECT_EQ(p.organs[0].material, "needle");
  ASSERT_NE(p.find_material("bark"), nullptr);
  EXPECT_EQ(p.find_material("bark")->reflectance, Vec3(0.5F, 0.4F, 0.3F));
  EXPECT_EQ(p.find_material("stone"), nullptr);
}

TEST(PlantParser, TakesAllNotationsOfProductions) {
  const Plant p = parse_plant(
      "axiom: A\n"
      "p1: A -> B\n"
      "A(l, w) : * -> !(w)F(l)\n"
      "p3: b < a(x) > c : x > 0 --> b////c : 0.5\n"
      "t -> [&FL!t]/////'[&FL!t]\n"
      "E ->\n",
      "x.lsys");
  ASSERT_EQ(p.system.productions.size(), 5U);
  EXPECT_TRUE(p.system.productions[1].condition.empty());
  EXPECT_EQ(p.system.productions[2].left.size(), 1U);
  EXPECT_EQ(p.system.productions[2].right.size(), 1U);
  EXPECT_EQ(p.system.productions[2].successor.size(), 6U);
  EXPECT_FALSE(p.system.productions[2].weight.empty());
  EXPECT_EQ(p.system.productions[3].successor.size(), 20U);
  EXPECT_TRUE(p.system.productions[4].successor.empty());
}

TEST(PlantParser, SaysWhatIsWrongAndWhere) {
  EXPECT_EQ(message("iterations 3\n"),
            "x.lsys: this plant has no axiom; expected a line 'axiom: WORD'");
  EXPECT_EQ(message("axiom: A\np1: A B\n"), "x.lsys:2:5: a production replaces exactly one module");
  EXPECT_EQ(message("axiom: A\np1: A F(2)\n"),
            "x.lsys:2:9: expected the name of a parameter, found '2'");
  EXPECT_EQ(message("axiom: A\np1: A\n"), "x.lsys:2:6: expected '->', found the end of the line");
  EXPECT_EQ(message("axiom: A\np1: A -> F(1\n"),
            "x.lsys:2:13: expected ',', ')' or an operator, found the end of the line");
  EXPECT_EQ(message("axiom: A\np1: A -> [F\n"), "x.lsys:2:10: '[' is never closed");
  EXPECT_EQ(message("axiom: F]\n"), "x.lsys:1:8: ']' without '['");
  EXPECT_EQ(message("axiom: A\n\niteration 4\n"),
            "x.lsys:3:1: unknown setting 'iteration'. Did you mean 'iterations'?");
  EXPECT_EQ(message("axiom: A\naxiom: B\n"), "x.lsys:2:6: there is already an axiom above");
  EXPECT_EQ(message("define a = 1\ndefine a = 2\n"), "x.lsys:2:8: 'a' is defined twice");
  EXPECT_EQ(message("angle 3\nangle 4\n"), "x.lsys:2:1: 'angle' is set twice");
  EXPECT_EQ(message("angle 3 4\n"), "x.lsys:1:9: expected the end of the line, found '4'");
  EXPECT_EQ(message("angle rand(1, 2)\n"),
            "x.lsys:1:7: a setting cannot be random; only modules and defines can");
  EXPECT_EQ(message("organ Leaf length 1\n"),
            "x.lsys:1:7: expected one letter, the name of an organ, found 'Leaf'");
  EXPECT_EQ(message("organ L lenght 1\n"),
            "x.lsys:1:9: unknown setting 'lenght' of 'organ'. Did you mean 'length'?");
  EXPECT_EQ(message("A(x, x) -> B\n"), "x.lsys:1:6: the parameter 'x' appears twice");
  EXPECT_EQ(message("axiom: ~ A\n"),
            "x.lsys:1:10: expected a letter directly after '~', found 'A'");
}

TEST(PlantParser, RefusesValuesOutOfRange) {
  EXPECT_NE(message("height -2\naxiom: F\n").find("x.lsys:1:8"), std::string::npos);
  EXPECT_NE(message("iterations 2.5\naxiom: F\n").find("x.lsys:1:12"), std::string::npos);
  EXPECT_NE(message("organ L shape cube\naxiom: F\n").find("x.lsys:1:15"), std::string::npos);
}

TEST(PlantParser, PlacesErrorsInContinuedLines) {
  EXPECT_EQ(message("axiom: A\np1: A ->\n    F(2)\n      F(q)\n").substr(0, 12), "x.lsys:4:9: ");
}

TEST(PlantParser, NamesAFileThatIsNotThere) {
  try {
    load_plant("nowhere/none.lsys");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::io);
    EXPECT_NE(error.message().find("nowhere/none.lsys"), std::string::npos);
  }
}

}  // namespace
}  // namespace wold
