#include "noise/lattice.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <string>

namespace wold {
namespace {

std::uint32_t hash2(int x, int y, std::uint32_t seed) {
  return lattice_hash(static_cast<std::uint32_t>(x),
                      lattice_line(static_cast<std::uint32_t>(y), lattice_key(seed)));
}
std::uint32_t hash3(int x, int y, int z, std::uint32_t seed) {
  const std::uint32_t plane = lattice_line(static_cast<std::uint32_t>(z), lattice_key(seed));
  return lattice_hash(static_cast<std::uint32_t>(x),
                      lattice_line(static_cast<std::uint32_t>(y), plane));
}

constexpr int side = 256;  // hashes around the origin, signs mixed

// How far χ² of equally likely classes lies from its mean, in standard deviations.
template <std::size_t classes>
double chi_square_deviation(const std::array<int, classes>& counts) {
  double total = 0;
  for (const int count : counts) total += count;
  const double expected = total / classes;
  double chi_square = 0;
  for (const int count : counts) chi_square += (count - expected) * (count - expected) / expected;
  return (chi_square - (classes - 1)) / std::sqrt(2.0 * (classes - 1));
}

TEST(Lattice, BitsOfAllPartsAreEvenlySpread) {
  for (const std::uint32_t seed : {0U, 1U, 0xffffffffU})
    for (const unsigned shift : {0U, 8U, 16U, 24U}) {
      std::array<int, 256> plane{};
      std::array<int, 256> space{};
      for (int y = -side / 2; y < side / 2; ++y)
        for (int x = -side / 2; x < side / 2; ++x) {
          ++plane[hash2(x, y, seed) >> shift & 255U];
          ++space[hash3(x, 3, y, seed) >> shift & 255U];
        }
      EXPECT_LT(std::abs(chi_square_deviation(plane)), 4.5) << shift;
      EXPECT_LT(std::abs(chi_square_deviation(space)), 4.5) << shift;
    }
}

TEST(Lattice, NeighboursAreIndependent) {
  // Pairs of gradient indices (four bits each) of neighbours in eight directions, of mirror images,
  // and of adjacent seeds are evenly spread over the 256 pairs.
  struct Partner {
    std::string name;
    std::uint32_t (*hash)(int, int);
  };
  const std::array<Partner, 12> partners{{
      {"east", [](int x, int y) { return hash2(x + 1, y, 7); }},
      {"north", [](int x, int y) { return hash2(x, y + 1, 7); }},
      {"north-east", [](int x, int y) { return hash2(x + 1, y + 1, 7); }},
      {"south-east", [](int x, int y) { return hash2(x + 1, y - 1, 7); }},
      {"two east", [](int x, int y) { return hash2(x + 2, y, 7); }},
      {"256 east", [](int x, int y) { return hash2(x + 256, y, 7); }},
      {"65536 north", [](int x, int y) { return hash2(x, y + 65536, 7); }},
      {"mirrored in x", [](int x, int y) { return hash2(-x - 1, y, 7); }},
      {"mirrored in y", [](int x, int y) { return hash2(x, -y - 1, 7); }},
      {"swapped", [](int x, int y) { return hash2(y, x + 300, 7); }},
      {"next seed", [](int x, int y) { return hash2(x, y, 8); }},
      {"seed far", [](int x, int y) { return hash2(x, y, 7U + 0x9e3779b9U); }},
  }};
  for (const Partner& partner : partners) {
    std::array<int, 256> counts{};
    for (int y = -side / 2; y < side / 2; ++y)
      for (int x = -side / 2; x < side / 2; ++x) {
        const std::uint32_t pair = (hash2(x, y, 7) >> 28U) * 16 + (partner.hash(x, y) >> 28U);
        ++counts[pair];
      }
    EXPECT_LT(std::abs(chi_square_deviation(counts)), 4.5) << partner.name;
  }
}

TEST(Lattice, EveryInputBitTurnsEveryOutputBitHalfTheTime) {
  constexpr int count = 4096;
  for (unsigned axis = 0; axis < 3; ++axis)
    for (unsigned bit = 0; bit < 32; ++bit) {
      std::array<int, 32> turned{};
      for (int i = 0; i < count; ++i) {
        std::array<std::uint32_t, 3> in{static_cast<std::uint32_t>(i % 64 - 32),
                                        static_cast<std::uint32_t>(i / 64 - 32), 5U};
        const auto hash = [&] {
          return lattice_hash(in[0], lattice_line(in[1], lattice_key(in[2])));
        };
        const std::uint32_t before = hash();
        in[axis] ^= 1U << bit;
        const std::uint32_t changes = before ^ hash();
        for (unsigned out = 0; out < 32; ++out)
          turned[out] += static_cast<int>(changes >> out & 1U);
      }
      // A seed enters once, so its changes are the same at each point but for the mixing after.
      for (unsigned out = 8; out < 32; ++out)
        EXPECT_NEAR(turned[out] / static_cast<double>(count), 0.5, 0.08)
            << "axis " << axis << " bit " << bit << " out " << out;
    }
}

TEST(Lattice, GradientsAreUnitVectorsEvenlySpread) {
  std::array<bool, 16> seen{};
  for (std::uint32_t h = 0; h < 16; ++h) {
    const Vec2 g = lattice_gradient2(h << 28U);
    EXPECT_NEAR(glm::length(g), gradient2_scale, 1e-6);
    const double turns = std::atan2(g.y, g.x) / (2 * pi_d) * 16 + 15.5;  // whole numbers
    EXPECT_NEAR(turns, std::round(turns), 1e-5);
    seen[static_cast<std::size_t>(std::lround(turns)) % 16] = true;
  }
  for (const bool s : seen) EXPECT_TRUE(s);

  // In space: moments up to the fourth are those of the sphere.
  DVec3 first(0);
  DMat3 second(0);
  DVec3 fourth(0);
  double mixed = 0;
  for (std::uint32_t h = 0; h < 32; ++h) {
    const DVec3 g = DVec3(lattice_gradient3(h << 27U)) / gradient3_scale;
    EXPECT_NEAR(glm::length(g), 1, 1e-6);
    first += g / 32.0;
    second += glm::outerProduct(g, g) / 32.0;
    fourth += g * g * g * g / 32.0;
    mixed += g.x * g.x * g.y * g.y / 32.0;
  }
  EXPECT_NEAR(glm::length(first), 0, 1e-7);
  for (int a = 0; a < 3; ++a) {
    for (int b = 0; b < 3; ++b) EXPECT_NEAR(second[a][b], a == b ? 1 / 3.0 : 0, 1e-6);
    EXPECT_NEAR(fourth[a], 1 / 5.0, 1e-6);
  }
  EXPECT_NEAR(mixed, 1 / 15.0, 1e-6);
}

TEST(Lattice, ValuesFillMinusOneToOne) {
  EXPECT_EQ(lattice_value(0), 0);
  EXPECT_NEAR(lattice_value(0x7fffffffU), 1, 2e-6);
  EXPECT_NEAR(lattice_value(0x80000000U), -1, 2e-6);
  EXPECT_LT(lattice_value(0x7fffffffU), 1);
  EXPECT_GT(lattice_value(0x80000000U), -1);
}

TEST(Lattice, HashesAreTheSameForever) {
  // What the GLSL twin must give too; a change here changes every landscape.
  EXPECT_EQ(hash2(0, 0, 0), 0x91069eafU);
  EXPECT_EQ(hash2(-3, 7, 1), 0x6296a1feU);
  EXPECT_EQ(hash3(-3, 7, 11, 1), 0xc86ec71fU);
}

}  // namespace
}  // namespace wold
