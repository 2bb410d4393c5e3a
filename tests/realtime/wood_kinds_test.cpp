#include "realtime/wood_kinds.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace wold {
namespace {

/// Rings of points up to a height of 10 m, so wide.
template <class Radius>
TriangleMesh rings(const Radius& radius) {
  TriangleMesh mesh;
  for (int j = 0; j < 300; ++j) {
    const float z = (static_cast<float>(j) + 0.5F) / 30;
    for (int i = 0; i < 8; ++i) {
      const float a = 0.785398F * static_cast<float>(i);
      mesh.positions.push_back(Vec3(radius(z) * std::cos(a), radius(z) * std::sin(a), z));
    }
  }
  return mesh;
}

TEST(WoodKinds, ShapesOfCrowns) {
  const CrownShape cone = crown_shape(rings([](float z) { return 0.2F * (10 - z); }));
  EXPECT_NEAR(cone.taper, 0.15F, 0.01F);
  EXPECT_NEAR(cone.slenderness, 0.18F, 0.005F);  // a tenth of the points is wider
  const CrownShape drum = crown_shape(rings([](float) { return 3.0F; }));
  EXPECT_NEAR(drum.taper, 1, 1e-4F);
  EXPECT_NEAR(drum.slenderness, 0.3F, 1e-3F);
  EXPECT_GT(crown_shape({}).taper, 0);
}

Scene wood(const std::string& scatters) {
  return parse_scene(
      "[[species]]\nname = \"spruce\"\nplant = \"plants/spruce.lsys\"\n"
      "height = [10, 20]\n[[species]]\nname = \"oak\"\n"
      "plant = \"plants/oak.lsys\"\nheight = [8, 12]\n[[species]]\n"
      "name = \"fern\"\nplant = \"plants/fern.lsys\"\nheight = [0.5, 1]\n" +
          scatters,
      std::string(WOLD_SOURCE_DIR) + "/scenes/test.toml", {});
}

TEST(WoodKinds, SpruceIsPointedAndOakIsRound) {
  Progress progress;
  const WoodKinds kinds =
      wood_kinds(wood("[[scatter]]\nspecies = { spruce = 1, oak = 1, fern = 2 }\ndensity = 0.04\n"
                      "[[scatter]]\nspecies = { spruce = 1 }\ndensity = 0.02\n"),
                 progress);
  EXPECT_NEAR(kinds.pointed.share, 0.75F, 1e-4F);
  EXPECT_NEAR(kinds.round.share, 0.25F, 1e-4F);
  EXPECT_NEAR(kinds.pointed.height.high, 20, 1e-3F);
  EXPECT_NEAR(kinds.round.height.low, 8, 1e-3F);
  EXPECT_LT(kinds.pointed.slenderness, kinds.round.slenderness);
}

TEST(WoodKinds, OneKindAloneIsAll) {
  Progress progress;
  const WoodKinds kinds =
      wood_kinds(wood("[[scatter]]\nspecies = { oak = 1 }\ndensity = 0.01\n"), progress);
  EXPECT_EQ(kinds.pointed.share, 0);
  EXPECT_NEAR(kinds.round.share, 1, 1e-6F);
}

}  // namespace
}  // namespace wold
