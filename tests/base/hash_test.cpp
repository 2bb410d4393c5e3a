#include "base/hash.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace wold {
namespace {

enum class Purpose { scatter, colour };

TEST(Hash, MixIsTheFinaliserOfSplitMix64) {
  // The first outputs of SplitMix64 with seed 0 and with seed 1234567 (Vigna's reference code).
  constexpr std::uint64_t step = 0x9e3779b97f4a7c15U;
  EXPECT_EQ(mix_bits(step), 0xe220a8397b1dcdafU);
  EXPECT_EQ(mix_bits(2 * step), 0x6e789e6aa1b965f4U);
  EXPECT_EQ(mix_bits(1234567 + step), 6457827717110365317U);
}

TEST(Hash, KeysDependOnEveryPartAndTheirOrder) {
  std::set<std::uint64_t> seen;
  for (const auto bits :
       {random_bits(1), random_bits(2), random_bits(1, 0), random_bits(1, 0, 0),
        random_bits(1, 1, 0), random_bits(1, 0, 1), random_bits(1, -1, 0), random_bits(1, 0, -1),
        random_bits(1, Purpose::colour, 7), random_bits(1, 7, Purpose::colour)})
    seen.insert(bits);
  EXPECT_EQ(seen.size(), 10U);
  EXPECT_EQ(random_bits(5, Purpose::scatter, -3), random_bits(5, Purpose::scatter, -3));
}

TEST(Hash, NeighbouringKeysShareHalfTheirBits) {
  double flipped = 0;
  constexpr int count = 10000;
  for (int k = 0; k < count; ++k)
    flipped += std::popcount(random_bits(9, k, 4) ^ random_bits(9, k + 1, 4));
  // Binomial: mean 32, deviation 4 for one pair.
  EXPECT_NEAR(flipped / count, 32, 5 * 4 / std::sqrt(count));
}

TEST(Hash, UniformNumbersAreUniform) {
  constexpr int cells = 64;
  constexpr int count = 64000;
  constexpr double expected = 1000;  // in each cell
  std::vector<int> observed(cells);
  double correlation = 0;
  for (int k = 0; k < count; ++k) {
    const float u = uniform(random_bits(3, k));
    ASSERT_GE(u, 0.0F);
    ASSERT_LT(u, 1.0F);
    ++observed[static_cast<std::size_t>(u * cells)];
    correlation += (static_cast<double>(u) - 0.5) * (uniform_double(random_bits(3, k, 1)) - 0.5);
  }
  double chi = 0;
  for (const int n : observed) chi += std::pow(n - expected, 2) / expected;
  EXPECT_LT(chi, 63 + 5 * std::sqrt(2.0 * 63));
  EXPECT_LT(std::abs(correlation / count), 5 / 12.0 / std::sqrt(count));
}

TEST(Hash, UniformNeverReachesOne) {
  EXPECT_LT(uniform(~std::uint64_t{0}), 1.0F);
  EXPECT_LT(uniform_double(~std::uint64_t{0}), 1.0);
  EXPECT_EQ(uniform(0), 0.0F);
  EXPECT_EQ(uniform_double(0), 0.0);
}

TEST(Hash, TextsByTheirBytes) {
  EXPECT_EQ(hash_text(std::string("birch")), hash_text(std::string_view("birch")));
  EXPECT_NE(hash_text(std::string("birch")), hash_text(std::string("brich")));
  EXPECT_NE(hash_text(std::string("")), hash_text(std::string(1, '\0')));
  // FNV-1a of the empty text is its offset basis.
  EXPECT_EQ(hash_text(std::string()), mix_bits(0xcbf29ce484222325U));
}

}  // namespace
}  // namespace wold
