#include "plants/lsystem.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "plants/plant.hpp"

namespace wold {
namespace {

Word derived(const std::string& text, int iterations, std::uint64_t seed = 0,
             int limit = 1'000'000) {
  const Plant plant = parse_plant(text, "test.lsys");
  Progress progress;
  return derive(plant.system, iterations, seed, {limit}, progress);
}

std::string word(const std::string& text, int iterations, std::uint64_t seed = 0) {
  return to_text(derived(text, iterations, seed));
}

std::map<char, int> counts(const Word& w) {
  std::map<char, int> result;
  for (const Module& m : w.modules) ++result[static_cast<char>(m.symbol)];
  return result;
}

// ABOP, section 1.2: a -> ab, b -> a.
TEST(LSystem, RewritesInParallel) {
  const std::string text = "axiom: b\np1: a -> ab\np2: b -> a\n";
  EXPECT_EQ(word(text, 0), "b");
  EXPECT_EQ(word(text, 1), "a");
  EXPECT_EQ(word(text, 2), "ab");
  EXPECT_EQ(word(text, 3), "aba");
  EXPECT_EQ(word(text, 4), "abaab");
  EXPECT_EQ(word(text, 5), "abaababa");
}

// ABOP, equation 1.1: Anabaena catenula; the cells r and l point right and left.
TEST(LSystem, GrowsAnabaena) {
  const std::string text =
      "axiom: R\nR -> lS\nL -> sR\nS -> R\ns -> L\nl -> L\n"
      "r -> R\n";
  EXPECT_EQ(word(text, 1), "lS");
  EXPECT_EQ(word(text, 2), "LR");
  EXPECT_EQ(word(text, 3), "sRlS");
  EXPECT_EQ(word(text, 4), "LlSLR");
}

// ABOP, fig. 1.6: the quadratic Koch island, n = 1.
TEST(LSystem, GrowsKochIsland) {
  const std::string text = "angle 90\naxiom: F-F-F-F\np1: F -> F-F+F+FF-F-F+F\n";
  EXPECT_EQ(word(text, 1), "F-F+F+FF-F-F+F-F-F+F+FF-F-F+F-F-F+F+FF-F-F+F-F-F+F+FF-F-F+F");
  EXPECT_EQ(counts(derived(text, 3))['F'], 4 * 8 * 8 * 8);
}

// ABOP, section 1.10.1.
TEST(LSystem, DerivesParametricWords) {
  const std::string text =
      "axiom: B(2)A(4, 4)\n"
      "p1: A(x, y) : y <= 3 -> A(x*2, x+y)\n"
      "p2: A(x, y) : y > 3 -> B(x)A(x/y, 0)\n"
      "p3: B(x) : x < 1 -> C\n"
      "p4: B(x) : x >= 1 -> B(x-1)\n";
  EXPECT_EQ(word(text, 1), "B(1)B(4)A(1, 0)");
  EXPECT_EQ(word(text, 2), "B(0)B(3)A(2, 1)");
  EXPECT_EQ(word(text, 3), "CB(2)A(4, 3)");
  EXPECT_EQ(word(text, 4), "CB(1)A(8, 7)");
  EXPECT_EQ(word(text, 5), "CB(0)B(8)A(1.14286, 0)");
}

// In each step F -> k F, and X adds j F and makes m X.
TEST(LSystem, CountsTheModulesOfFlatPlants) {
  const auto file = [](char letter) {
    return load_plant(std::string(WOLD_SOURCE_DIR "/plants/abop_1_24") + letter + ".lsys");
  };
  const auto count = [](const Plant& plant, int n) {
    Progress progress;
    return counts(derive(plant.system, n, 0, {}, progress));
  };
  for (int n = 0; n <= 4; ++n) {
    const double steps = n;
    EXPECT_EQ(count(file('a'), n)['F'], std::pow(5, steps));
    EXPECT_EQ(count(file('b'), n)['F'], std::pow(5, steps));
    EXPECT_EQ(count(file('c'), n)['F'], std::pow(8, steps));
    EXPECT_EQ(count(file('d'), n)['X'], std::pow(3, steps));
    EXPECT_EQ(count(file('e'), n)['X'], std::pow(3, steps));
    EXPECT_EQ(count(file('f'), n)['X'], std::pow(4, steps));
    // F(n+1) = 2 F(n) + 2 X(n), so F(n) = 2 (3^n - 2^n).
    EXPECT_EQ(count(file('d'), n)['F'], 2 * (std::pow(3, steps) - std::pow(2, steps)));
  }
}

TEST(LSystem, CopiesModulesOfOtherArity) {
  EXPECT_EQ(word("axiom: A A(1) A(1, 2)\np1: A(x) -> B(x)\n", 1), "AB(1)A(1, 2)");
}

TEST(LSystem, TakesTheFirstProductionThatMatches) {
  EXPECT_EQ(word("axiom: A(2)\np1: A(x) : x > 1 -> B\np2: A(x) : x > 0 -> C\n", 1), "B");
}

// ABOP, section 1.7: three productions of equal probability.
TEST(LSystem, DrawsProductionsByWeight) {
  std::string axiom;
  for (int k = 0; k < 20000; ++k) axiom += 'A';
  const std::string text = "axiom: " + axiom + "\np1: A -> B : 1\np2: A -> C : 2\np3: A -> D : 5\n";
  auto n = counts(derived(text, 1, 7));
  EXPECT_EQ(n['B'] + n['C'] + n['D'], 20000);
  // Within four deviations of the expected counts.
  EXPECT_NEAR(n['B'], 2500, 4 * std::sqrt(20000 * 0.125 * 0.875));
  EXPECT_NEAR(n['C'], 5000, 4 * std::sqrt(20000 * 0.25 * 0.75));
  EXPECT_EQ(word(text, 1, 7), word(text, 1, 7));
  EXPECT_NE(word(text, 1, 7), word(text, 1, 8));
}

// ABOP, section 1.8: a signal that moves to the right, and one that moves to the root.
TEST(LSystem, SeesItsNeighbours) {
  const std::string right = "axiom: baaa\np1: b < a -> b\np2: b -> a\n";
  EXPECT_EQ(word(right, 1), "abaa");
  EXPECT_EQ(word(right, 3), "aaab");
  const std::string up =
      "ignore +-\naxiom: F(1)[+F(0)[-F(0)]F(0)][-F(0)]F(0)\n"
      "p1: F(a) < F(b) : b < a -> F(a)\n";
  EXPECT_EQ(word(up, 1), "F(1)[+F(1)[-F(0)]F(0)][-F(1)]F(1)");
  EXPECT_EQ(word(up, 2), "F(1)[+F(1)[-F(1)]F(1)][-F(1)]F(1)");
  const std::string down =
      "ignore +-\naxiom: F(0)[+F(0)]F(0)[-F(1)]F(1)\n"
      "p1: F(a) > F(b) : b > a -> F(b)\n";
  EXPECT_EQ(word(down, 1), "F(0)[+F(0)]F(1)[-F(1)]F(1)");
  EXPECT_EQ(word(down, 2), "F(1)[+F(0)]F(1)[-F(1)]F(1)");
}

// ABOP, page 32: BC < S > G[H]M matches S in ABC[DE][SG[HI[JK]L]MNO].
TEST(LSystem, MatchesTheContextExampleOfTheBook) {
  const std::string text = "axiom: ABC[DE][SG[HI[JK]L]MNO]\np1: BC < S > G[H]M -> X\n";
  EXPECT_EQ(word(text, 1), "ABC[DE][XG[HI[JK]L]MNO]");
  EXPECT_EQ(word("axiom: ABC[DE][SG[HI]NO]\np1: BC < S > G[H]M -> X\n", 1), "ABC[DE][SG[HI]NO]");
}

TEST(LSystem, CutsBranches) {
  EXPECT_EQ(word("axiom: A[BCD[E]F]G\np1: C -> %\n", 1), "A[B]G");
  EXPECT_EQ(word("axiom: AC[E]F\np1: C -> %\n", 1), "A");
}

TEST(LSystem, RefusesWordsThatAreTooLong) {
  try {
    derived("axiom: F\np1: F -> FF\n", 60, 0, 1000);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::limit);
    EXPECT_NE(error.message().find("after 10 iterations the word would have 1024 modules"),
              std::string::npos)
        << error.message();
  }
}

TEST(LSystem, StopsWhenCancelled) {
  const Plant plant = parse_plant("axiom: F\np1: F -> FF\n", "test.lsys");
  Progress progress;
  progress.cancel();
  EXPECT_THROW(derive(plant.system, 5, 0, {}, progress), Error);
}

TEST(LSystem, DefinesAreDrawnOncePerModel) {
  const std::string text = "define a = rand(0, 1)\ndefine b = 2*a\naxiom: A(a)B(b)\n";
  const Word w = derived(text, 0, 3);
  EXPECT_EQ(w.values.at(1), 2 * w.values.at(0));
  EXPECT_NE(derived(text, 0, 4).values.at(0), w.values.at(0));
}

TEST(LSystem, RefusesWeightsThatAreNone) {
  EXPECT_THROW(derived("axiom: A\np1: A -> B : -1\n", 1), Error);
}

}  // namespace
}  // namespace wold
