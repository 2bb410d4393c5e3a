#include "plants/expression.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "plants/expression_parser.hpp"

namespace wold {
namespace {

double value(const std::string& text, std::uint64_t key = 0) {
  const Statement statement = split_statements(text, "test").front();
  StatementReader reader(statement);
  const std::vector<std::string> constants{"k"};
  const std::vector<std::string> arguments{"x", "y"};
  std::uint32_t place = 0;
  const Expression e = parse_expression(reader, {constants, arguments, &place});
  EXPECT_TRUE(reader.at_end()) << text;
  const std::vector<double> k{10};
  const std::vector<double> xy{3, 4};
  return e.evaluate({k, xy, key});
}

std::string message(const std::string& text) {
  try {
    value(text);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(Expression, FollowsTheUsualPrecedence) {
  EXPECT_EQ(value("1+2*3"), 7);
  EXPECT_EQ(value("(1+2)*3"), 9);
  EXPECT_EQ(value("10-4-3"), 3);
  EXPECT_EQ(value("12/3/2"), 2);
  EXPECT_EQ(value("2^3^2"), 512);
  EXPECT_EQ(value("-2^2"), -4);
  EXPECT_EQ(value("2^-1"), 0.5);
  EXPECT_EQ(value("7 % 4"), 3);
  EXPECT_EQ(value("1 < 2 && 3 >= 4 || !0"), 1);
  EXPECT_EQ(value("x*x + y*y == 25"), 1);
  EXPECT_EQ(value("x != y"), 1);
  EXPECT_EQ(value("k - x"), 7);
}

TEST(Expression, KnowsItsFunctions) {
  EXPECT_NEAR(value("sin(30)"), 0.5, 1e-15);
  EXPECT_NEAR(value("cos(60)"), 0.5, 1e-15);
  EXPECT_NEAR(value("atan2(1, 1)"), 45, 1e-13);
  EXPECT_EQ(value("sqrt(x*x + y*y)"), 5);
  EXPECT_EQ(value("pow(2, 5)"), 32);
  EXPECT_EQ(value("min(x, y) + max(x, y)"), 7);
  EXPECT_EQ(value("floor(-1.5) + ceil(1.2) + round(2.6)"), 3);
  EXPECT_EQ(value("abs(-3) * sign(-2)"), -3);
  EXPECT_EQ(value("mix(2, 4, 0.25)"), 2.5);
  EXPECT_EQ(value("clamp(12, 0, 10)"), 10);
  EXPECT_EQ(value("smoothstep(0, 2, 1)"), 0.5);
  EXPECT_EQ(value("if(x > y, 1, 2)"), 2);
}

TEST(Expression, RandomNumbersAreHashesOfKeyAndPlace) {
  EXPECT_EQ(value("rand(0, 1)", 5), value("rand(0, 1)", 5));
  EXPECT_NE(value("rand(0, 1)", 5), value("rand(0, 1)", 6));
  EXPECT_NE(value("rand(0, 1) - rand(0, 1)", 5), 0);
  double sum = 0;
  double squares = 0;
  constexpr int count = 20000;
  for (std::uint64_t key = 0; key < count; ++key) {
    const double u = value("rand(2, 4)", key);
    EXPECT_GE(u, 2);
    EXPECT_LT(u, 4);
    const double n = value("normal(1, 2)", key);
    sum += n;
    squares += (n - 1) * (n - 1);
  }
  EXPECT_NEAR(sum / count, 1, 0.05);
  EXPECT_NEAR(std::sqrt(squares / count), 2, 0.06);
}

TEST(Expression, SaysWhatIsWrongAndWhere) {
  EXPECT_EQ(message("1 + * 2"), "test:1:5: expected a number, a name or '(', found '*'");
  EXPECT_EQ(message("2 * (3 + 4"), "test:1:11: expected ')', found the end of the line");
  EXPECT_EQ(message("1 + sqr(4)"), "test:1:5: unknown function 'sqr'. Did you mean 'sqrt'?");
  EXPECT_EQ(message("min(1)"), "test:1:6: expected ',' (min takes 2 arguments), found ')'");
  EXPECT_NE(message("2 * z").find("test:1:5: 'z' is neither a parameter here nor defined above."),
            std::string::npos);
  EXPECT_NE(message(std::string(5000, '(')).find("too deep"), std::string::npos);
  EXPECT_NE(message(std::string(5000, '-')).find("too deep"), std::string::npos);
}

}  // namespace
}  // namespace wold
