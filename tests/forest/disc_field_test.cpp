#include "forest/disc_field.hpp"

#include <gtest/gtest.h>

#include <array>

#include "base/hash.hpp"
#include "forest/spacing.hpp"

namespace wold {
namespace {

TEST(DiscField, FindsWhatAnExhaustiveSearchFinds) {
  const std::array<float, 3> class_radius{4, 2, 1};
  DiscField field({-30, 10}, {50, 70}, class_radius);
  struct Disc {
    DVec2 centre;
    float radius;
    bool certain;
  };
  std::vector<Disc> discs;
  int seen[3] = {0, 0, 0};
  for (int n = 0; n < 900; ++n) {
    const int size_class = n / 300;
    const auto draw = [&](int what) { return uniform(random_bits(3, n, what)); };
    const DVec2 p{-30 + 80.0 * draw(0), 10 + 60.0 * draw(1)};
    const float radius = class_radius[size_class] * (0.51F + 0.49F * draw(2));
    DiscFit expected = DiscFit::free;
    for (const Disc& d : discs)
      if (glm::length(d.centre - p) < static_cast<double>(d.radius + radius)) {
        if (d.certain) expected = DiscFit::taken;
        if (!d.certain && expected == DiscFit::free) expected = DiscFit::uncertain;
      }
    ASSERT_EQ(field.test(p, radius, size_class), expected);
    ++seen[static_cast<int>(expected)];
    if (draw(3) < 0.15F) {
      const bool certain = draw(4) < 0.5F;
      field.add(p, radius, size_class, certain);
      discs.push_back({p, radius, certain});
    }
  }
  for (const int s : seen) EXPECT_GT(s, 20);
}

TEST(Spacing, EqualDiscsReachTheirDensityAsRandomSequentialAdsorptionDoes) {
  // Coverage 0.35 of discs of radius 1. Schaaf and Talbot 1989 (J. Chem. Phys. 91, 4401), the
  // chance that there is room at coverage θ: (1 - x)³ (1 + 0.812 x + 0.4258 x² + 0.0716 x³), x =
  // θ/0.547; so candidates are ∫ dθ / chance / π.
  const std::array<float, 1> radius{1};
  const std::array<double, 1> density{0.35 / pi_d};
  const SpacingPlan plan = plan_spacing(radius, density);
  EXPECT_NEAR(plan.reached() / density[0], 1, 0.02);
  double candidates = 0;
  for (int k = 0; k < 1000; ++k) {
    const double x = 0.35 * (k + 0.5) / 1000 / 0.547;
    const double chance = std::pow(1 - x, 3) * (1 + x * (0.812 + x * (0.4258 + x * 0.0716)));
    candidates += 0.35 / 1000 / chance / pi_d;
  }
  EXPECT_NEAR(plan.candidates / candidates, 1, 0.06);
}

TEST(Spacing, SaysWhatCannotBeReached) {
  const std::array<float, 1> radius{1};
  const std::array<double, 1> density{0.8 / pi_d};
  const SpacingPlan plan = plan_spacing(radius, density);
  EXPECT_LT(plan.reached() * pi_d, 0.56);
  EXPECT_GT(plan.reached() * pi_d, 0.45);
  EXPECT_LE(plan.candidates, most_candidates * density[0] * 1.0001);
}

TEST(Spacing, SharesRiseFromNothingToAll) {
  const std::array<float, 2> radius{2, 0.3F};
  const std::array<double, 2> density{0.01, 0.3};
  for (const DiscKind& kind : plan_spacing(radius, density).kinds) {
    EXPECT_EQ(kind.share_for(0), 0);
    EXPECT_EQ(kind.share_for(1), 1);
    for (double part = 0; part < 1; part += 0.1)
      EXPECT_LE(kind.share_for(part), kind.share_for(part + 0.1));
  }
}

}  // namespace
}  // namespace wold
