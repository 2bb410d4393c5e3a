#include "base/value.hpp"

#include <gtest/gtest.h>

#include "base/error.hpp"

namespace wold {
namespace {

TEST(Value, TextIsTomlSource) {
  EXPECT_EQ(to_text(Value(true)), "true");
  EXPECT_EQ(to_text(Value(std::int64_t{-7})), "-7");
  EXPECT_EQ(to_text(Value(0.25)), "0.25");
  EXPECT_EQ(to_text(Value(std::string("hill"))), "\"hill\"");
  EXPECT_EQ(to_text(Value(std::vector<double>{1, 0.5})), "[1, 0.5]");
  EXPECT_EQ(to_text(Value(Weights{{"birch", 3}, {"fern", 0.5}})), "{ birch = 3, fern = 0.5 }");
  EXPECT_EQ(to_text(Value(Weights{})), "{ }");
  EXPECT_EQ(to_text(Value(std::vector<std::string>{"a", "b"})), "[\"a\", \"b\"]");
}

TEST(Value, NumbersThatCameFromFloatsAreShort) {
  EXPECT_EQ(to_text(Value(static_cast<double>(0.1F))), "0.1");
  EXPECT_EQ(to_text(Value(0.123456789012)), "0.123456789012");
}

TEST(Value, KindsAreNamed) {
  EXPECT_EQ(kind_text(Value(std::int64_t{1})), "an integer");
  EXPECT_EQ(kind_text(Value(1.5)), "a number");
  EXPECT_EQ(kind_text(Value(std::vector<double>{1, 2})), "a list of 2 numbers");
  EXPECT_EQ(kind_text(Value(DateTime{})), "a date and time");
}

TEST(Value, DatesReadAsWritten) {
  for (const char* text : {"2026-06-21T18:30:00+02:00", "1999-12-31T23:59:59Z",
                           "2024-02-29T00:00:00-09:30", "0800-01-01T06:00:00Z"})
    EXPECT_EQ(to_text(parse_date_time(text)), text);
}

TEST(Value, DatesMayLeaveOutSecondsAndOffset) {
  EXPECT_EQ(parse_date_time("2026-06-21 18:30"), (DateTime{2026, 6, 21, 18, 30, 0, 0}));
  EXPECT_EQ(parse_date_time("2026-06-21T18:30+01:00"), (DateTime{2026, 6, 21, 18, 30, 0, 60}));
  EXPECT_DOUBLE_EQ(parse_date_time("2026-06-21T18:30:15.5Z").second, 15.5);
}

TEST(Value, WhatIsNoDateIsRefused) {
  for (const char* text :
       {"", "tomorrow", "2026-06-21", "2026-13-01T00:00:00Z", "2026-06-31T00:00:00Z",
        "2026-02-30T10:00:00Z", "2026-06-21T24:00:00Z", "2026-06-21T18:30:00+2",
        "2026-06-21T18:30:00Zulu", "2026-06-21T18:60:00Z", "2026-06-21T18:30:-5Z",
        "2026-06-21T18:30:nanZ", "2025-02-29T10:00:00Z", "1900-02-29T10:00:00Z"})
    EXPECT_THROW(parse_date_time(text), Error) << text;
}

}  // namespace
}  // namespace wold
