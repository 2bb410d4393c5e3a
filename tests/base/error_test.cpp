#include "base/error.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace wold {
namespace {

TEST(Error, NamesItsPlaceAsFarAsItIsKnown) {
  EXPECT_STREQ(Error(ErrorKind::input, "bad", {"scene.toml", 12, 9}).what(),
               "scene.toml:12:9: bad");
  EXPECT_STREQ(Error(ErrorKind::input, "bad", {"scene.toml", 12, 0}).what(), "scene.toml:12: bad");
  EXPECT_STREQ(Error(ErrorKind::input, "bad", {"scene.toml", 0, 0}).what(), "scene.toml: bad");
  EXPECT_STREQ(Error(ErrorKind::input, "bad").what(), "bad");
}

TEST(Error, AtGivesAPlaceOnlyWhereThereIsNone) {
  const Error without(ErrorKind::limit, "too large");
  const Error with = without.at({"a.toml", 3, 1});
  EXPECT_EQ(with.kind(), ErrorKind::limit);
  EXPECT_EQ(with.message(), "too large");
  EXPECT_STREQ(with.what(), "a.toml:3:1: too large");
  EXPECT_STREQ(with.at({"b.toml", 1, 1}).what(), "a.toml:3:1: too large");
}

TEST(Error, EditDistanceCountsInsertDeleteReplaceAndSwap) {
  EXPECT_EQ(edit_distance("", ""), 0);
  EXPECT_EQ(edit_distance("", "abc"), 3);
  EXPECT_EQ(edit_distance("octave", "octaves"), 1);
  EXPECT_EQ(edit_distance("octaves", "octave"), 1);
  EXPECT_EQ(edit_distance("height", "weight"), 1);
  EXPECT_EQ(edit_distance("hieght", "height"), 1);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3);
  EXPECT_EQ(edit_distance("sitting", "kitten"), 3);
}

TEST(Error, SuggestsTheNearestOrListsAll) {
  const std::vector<std::string> known{"ridged", "fbm", "hybrid"};
  EXPECT_EQ(closest_name("rigded", known), "ridged");
  EXPECT_EQ(closest_name("volcano", known), "");
  EXPECT_EQ(suggestion("hybird", known), " Did you mean 'hybrid'?");
  EXPECT_EQ(suggestion("volcano", known), " Known: ridged, fbm, hybrid.");
  EXPECT_EQ(suggestion("volcano", {}), "");
}

}  // namespace
}  // namespace wold
