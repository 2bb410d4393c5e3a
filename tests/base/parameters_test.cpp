#include "base/parameters.hpp"

#include <gtest/gtest.h>

namespace wold {
namespace {

enum class Shape { round, square };

struct Sample {
  float height = 900;
  int octaves = 10;
  bool smooth = false;
  std::string name = "hill";
  Shape shape = Shape::round;
  Range slope{0, 35};
  Vec3 colour{0.1F, 0.2F, 0.3F};
  DateTime time;
  Weights species;
};

Description<Sample> describe(const Sample&) {
  return Description<Sample>("sample", "A struct for tests.")
      .add("height", &Sample::height, {.unit = "m", .min = 0, .max = 9000}, "How high.")
      .add("octaves", &Sample::octaves, {.min = 1, .max = 24}, "How many.")
      .add("smooth", &Sample::smooth, "Whether smooth.")
      .add("name", &Sample::name, "What it is called.")
      .choice("shape", &Sample::shape, {"round", "square"}, "Its shape.")
      .add("slope", &Sample::slope, {.unit = "degrees", .min = 0, .max = 90}, "Where.")
      .add("colour", &Sample::colour, {.min = 0, .max = 1}, "Its colour.")
      .add("time", &Sample::time, "When.")
      .add("species", &Sample::species, "Which.");
}

std::string error_of(const std::string& name, const Value& value) {
  Sample sample;
  try {
    ParameterSet(describe(sample)).assign(&sample, name, value, {"scene.toml", 12, 9});
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(Parameters, AssignsEveryKind) {
  Sample s;
  const ParameterSet set = describe(s);
  set.assign(&s, "height", 120.5);
  set.assign(&s, "octaves", std::int64_t{4});
  set.assign(&s, "smooth", true);
  set.assign(&s, "name", std::string("rock"));
  set.assign(&s, "shape", std::string("square"));
  set.assign(&s, "slope", std::vector<double>{5, 20});
  set.assign(&s, "colour", std::vector<double>{1, 0.5, 0});
  set.assign(&s, "time", std::string("2026-06-21T18:30:00+02:00"));
  set.assign(&s, "species", Weights{{"birch", 3}});
  EXPECT_EQ(s.height, 120.5F);
  EXPECT_EQ(s.octaves, 4);
  EXPECT_TRUE(s.smooth);
  EXPECT_EQ(s.name, "rock");
  EXPECT_EQ(s.shape, Shape::square);
  EXPECT_EQ(s.slope, (Range{5, 20}));
  EXPECT_EQ(s.colour, Vec3(1, 0.5F, 0));
  EXPECT_EQ(s.time, (DateTime{2026, 6, 21, 18, 30, 0, 120}));
  EXPECT_EQ(s.species.front().first, "birch");
}

TEST(Parameters, AcceptsAnIntegerForANumber) {
  Sample s;
  ParameterSet(describe(s)).assign(&s, "height", std::int64_t{7});
  EXPECT_EQ(s.height, 7.0F);
}

TEST(Parameters, UnknownNameSuggestsTheNearest) {
  EXPECT_EQ(error_of("octave", std::int64_t{1}),
            "scene.toml:12:9: unknown parameter 'octave' in 'sample'. Did you mean 'octaves'?");
}

TEST(Parameters, WrongKindSaysWhatIsAllowed) {
  EXPECT_EQ(error_of("height", std::string("tall")),
            "scene.toml:12:9: 'height' in 'sample' is a text (\"tall\"), but must be a number, "
            "0 to 9000 m");
}

TEST(Parameters, OutOfRangeSaysWhatIsAllowed) {
  EXPECT_EQ(error_of("octaves", std::int64_t{40}),
            "scene.toml:12:9: 'octaves' in 'sample' is 40, but must be an integer, 1 to 24");
  EXPECT_NE(error_of("slope", std::vector<double>{30, 10}), "no error");
  EXPECT_NE(error_of("colour", std::vector<double>{1, 1}), "no error");
  EXPECT_NE(error_of("shape", std::string("squar")), "no error");
  EXPECT_NE(error_of("time", std::string("2026-13-01T00:00:00Z")), "no error");
  EXPECT_NE(error_of("height", std::numeric_limits<double>::quiet_NaN()), "no error");
}

TEST(Parameters, DescribedCopiesAreIndependent) {
  Described a = Described::of(Sample{});
  Described b = a;
  b.assign("height", 5.0);
  EXPECT_EQ(a.as<Sample>().height, 900.0F);
  EXPECT_EQ(b.as<Sample>().height, 5.0F);
}

TEST(Parameters, HelpNamesEveryParameterWithItsDefault) {
  const Sample s;
  const std::string help = help_text(describe(s), &s);
  for (const std::string& name : describe(s).parameters().names())
    EXPECT_NE(help.find("  " + name), std::string::npos) << name;
  EXPECT_NE(help.find("default 900"), std::string::npos);
}

}  // namespace
}  // namespace wold
