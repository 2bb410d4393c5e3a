#include "render/sampler.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

namespace wold {
namespace {

/// The second dimension by its direction numbers: m_1 = 1, m_k = 2 m_{k-1} xor m_{k-1} (polynomial
/// x + 1).
std::uint32_t second_dimension(std::uint32_t index) {
  std::uint32_t x = 0;
  std::uint32_t direction = 0x80000000U;
  for (; index != 0; index >>= 1U) {
    if ((index & 1U) != 0) x ^= direction;
    direction ^= direction >> 1U;
  }
  return x;
}

TEST(Sampler, SobolMatchesItsDirectionNumbers) {
  for (std::uint32_t k = 0; k < 5000; ++k) {
    const std::uint32_t index = k * 2654435761U;
    EXPECT_EQ(sobol_point(index).y, second_dimension(index));
  }
  EXPECT_EQ(sobol_point(1).x, 0x80000000U);
  EXPECT_EQ(sobol_point(6).x, 0x60000000U);
}

/// Every elementary interval of area 1/64 holds one of 64 points: a (0, 6, 2)-net.
TEST(Sampler, AlignedBlocksAreNetsAfterScrambling) {
  for (std::uint32_t block = 0; block < 4; ++block) {
    for (int bits = 0; bits <= 6; ++bits) {
      std::set<std::pair<int, int>> cells;
      for (std::uint32_t k = 0; k < 64; ++k) {
        Sampler sampler(9, 3, 4, block * 64 + k);
        const Vec2 u = sampler.next();
        cells.insert({static_cast<int>(u.x * static_cast<float>(1 << bits)),
                      static_cast<int>(u.y * static_cast<float>(1 << (6 - bits)))});
      }
      EXPECT_EQ(cells.size(), 64U) << "block " << block << ", bits " << bits;
    }
  }
}

TEST(Sampler, DependsOnPixelIndexDimensionAndSeedAlone) {
  Sampler a(1, 5, 6, 77);
  Sampler b(1, 5, 6, 77);
  a.next();
  b.skip_to(1);
  EXPECT_EQ(a.next(), b.next());
  EXPECT_NE(Sampler(1, 5, 6, 77).next(), Sampler(2, 5, 6, 77).next());
  EXPECT_NE(Sampler(1, 5, 6, 77).next(), Sampler(1, 6, 5, 77).next());
}

TEST(Sampler, DimensionsAreIndependent) {
  // Correlation between pairs over many pixels is that of independent numbers.
  double sum = 0;
  constexpr int count = 20000;
  for (int k = 0; k < count; ++k) {
    Sampler s(3, k % 200, k / 200, 0);
    const Vec2 a = s.next();
    const Vec2 b = s.next();
    sum += (static_cast<double>(a.x) - 0.5) * (static_cast<double>(b.x) - 0.5);
  }
  const double deviation = 1.0 / 12 / std::sqrt(count);
  EXPECT_LT(std::abs(sum / count), 4 * deviation);
}

TEST(Sampler, IntegratesFasterThanRandomNumbers) {
  // Integral of x·y over the square is 1/4; 1024 random points have a deviation of 0.0069.
  double worst = 0;
  for (int pixel = 0; pixel < 16; ++pixel) {
    double sum = 0;
    for (std::uint32_t k = 0; k < 1024; ++k) {
      const Vec2 u = Sampler(0, pixel, 0, k).next();
      sum += static_cast<double>(u.x * u.y);
    }
    worst = std::max(worst, std::abs(sum / 1024 - 0.25));
  }
  EXPECT_LT(worst, 0.0006);
}

}  // namespace
}  // namespace wold
