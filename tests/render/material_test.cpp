#include "render/material.hpp"

#include <gtest/gtest.h>

#include <set>

#include "base/hash.hpp"

namespace wold {
namespace {

Vec3 place(int k) {
  return 20.0F * Vec3(uniform(random_bits(1, k, 0)), uniform(random_bits(1, k, 1)),
                      uniform(random_bits(1, k, 2)));
}

void expect_energy(const Material& settings) {
  const SurfaceMaterial material(settings);
  for (int k = 0; k < 2000; ++k) {
    const auto individual = static_cast<std::uint32_t>(k % 40);
    const SurfaceColor c = material.at(place(k), 0.001F * static_cast<float>(k), individual,
                                       static_cast<std::uint32_t>(k));
    for (int channel = 0; channel < 3; ++channel) {
      EXPECT_GE(c.reflectance[channel], 0) << settings.name;
      EXPECT_GE(c.transmittance[channel], 0) << settings.name;
      EXPECT_LE(c.reflectance[channel] + c.transmittance[channel], 0.95001F) << settings.name;
    }
  }
}

TEST(Material, GivesBackNoMoreThanItGets) {
  std::set<std::string> names;
  for (const Material& m : standard_materials()) {
    expect_energy(m);
    EXPECT_TRUE(names.insert(m.name).second) << m.name << " is there twice";
  }
  EXPECT_GT(names.size(), 5U);
}

TEST(Material, KeepsEnergyWithTheWhitestSettings) {
  Material white;
  white.name = "white";
  white.color1 = white.color2 = white.transmission = Vec3(1);
  white.variation = 1;
  white.contrast = 20;
  expect_energy(white);
}

TEST(Material, WithoutVariationOneColourIsOneColour) {
  Material m;
  m.color1 = m.color2 = {0.2F, 0.3F, 0.4F};
  m.transmission = {0.1F, 0.2F, 0.3F};
  m.variation = 0;
  const SurfaceMaterial material(m);
  for (int k = 0; k < 100; ++k) {
    const auto n = static_cast<std::uint32_t>(k);
    const SurfaceColor c = material.at(place(k), 0.01F, n, n);
    EXPECT_LT(glm::distance(c.reflectance, m.color1), 1e-6F);
    EXPECT_LT(glm::distance(c.transmittance, m.transmission), 1e-6F);
  }
}

TEST(Material, TextureMixesItsTwoColours) {
  const TwoColorTexture texture({Vec3(0.2F), Vec3(0.6F), 2, 1}, 5);
  double sum = 0;
  float low = 1;
  float high = 0;
  constexpr int count = 5000;
  for (int k = 0; k < count; ++k) {
    const float x = texture.at(10.0F * place(k), 0).x;
    low = std::min(low, x);
    high = std::max(high, x);
    sum += static_cast<double>(x);
  }
  EXPECT_GE(low, 0.2F - 1e-6F);
  EXPECT_LE(high, 0.6F + 1e-6F);
  EXPECT_GT(high - low, 0.15F);
  EXPECT_NEAR(sum / count, 0.4, 0.02);
}

}  // namespace
}  // namespace wold
