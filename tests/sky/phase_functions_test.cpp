#include "sky/phase_functions.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "base/hash.hpp"

namespace wold {
namespace {

using Phase = std::function<float(float)>;

/// ∫ p dω and ∫ p cos θ dω, by midpoints in θ.
DVec2 moments(const Phase& phase) {
  constexpr int n = 200000;
  DVec2 sum(0);
  for (int k = 0; k < n; ++k) {
    const double theta = pi_d * (k + 0.5) / n;
    const double c = std::cos(theta);
    const double weight = static_cast<double>(phase(static_cast<float>(c))) * std::sin(theta);
    sum += DVec2(weight, weight * c);
  }
  return sum * (2 * pi_d * pi_d / n);
}

struct Named {
  const char* name;
  Phase phase;
  double mean_cosine;
};

std::vector<Named> all_phases() {
  std::vector<Named> list = {{"isotropic", [](float) { return isotropic_phase(); }, 0},
                             {"rayleigh", rayleigh_phase, 0}};
  for (const float g : {-0.9F, -0.5F, 0.0F, 0.3F, 0.76F, 0.95F}) {
    const double gd = g;
    list.push_back({"hg", [g](float c) { return henyey_greenstein(c, g); }, gd});
    list.push_back({"mie", [g](float c) { return mie_phase(c, g); },
                    3 * gd * (4 + gd * gd) / (5 * (2 + gd * gd))});
    const double k = schlick_k(g);
    const double schlick_mean =
        k == 0 ? 0 : 1 / k - (1 - k * k) / (2 * k * k) * std::log((1 + k) / (1 - k));
    list.push_back(
        {"schlick", [g](float c) { return schlick_phase(c, schlick_k(g)); }, schlick_mean});
  }
  list.push_back({"double hg",
                  [](float c) { return double_henyey_greenstein(c, 0.7F, -0.5F, 0.4F); },
                  0.6 * 0.7 - 0.4 * 0.5});
  return list;
}

TEST(PhaseFunctions, IntegrateToOneWithTheMeanCosineOfTheirFormula) {
  for (const Named& p : all_phases()) {
    const DVec2 m = moments(p.phase);
    EXPECT_NEAR(m.x, 1, 2e-4) << p.name;
    EXPECT_NEAR(m.y, p.mean_cosine, 3e-4) << p.name << " " << p.mean_cosine;
  }
}

TEST(PhaseFunctions, MieIsRayleighWithoutDirection) {
  for (float c = -1; c <= 1; c += 0.125F) EXPECT_FLOAT_EQ(mie_phase(c, 0), rayleigh_phase(c));
}

TEST(PhaseFunctions, SchlickFollowsHenyeyGreenstein) {
  for (const float g : {-0.6F, -0.2F, 0.1F, 0.4F, 0.6F}) {
    double difference = 0;  // of probability
    constexpr int n = 2000;
    for (int k = 0; k < n; ++k) {
      const float c = 2 * (static_cast<float>(k) + 0.5F) / n - 1;
      difference +=
          static_cast<double>(std::abs(schlick_phase(c, schlick_k(g)) - henyey_greenstein(c, g)));
    }
    EXPECT_LT(difference * 4 * pi_d / n, 0.09) << g;
  }
  // No other k does much better: the fit is the fit.
  const auto distance = [](float g, float k) {
    double sum = 0;
    for (float c = -0.995F; c < 1; c += 0.01F) {
      const double d = static_cast<double>(schlick_phase(c, k) - henyey_greenstein(c, g));
      sum += d * d;
    }
    return sum;
  };
  const float k = schlick_k(0.5F);
  EXPECT_LT(distance(0.5F, k), distance(0.5F, k - 0.1F));
  EXPECT_LT(distance(0.5F, k), distance(0.5F, k + 0.1F));
}

TEST(PhaseFunctions, SamplesFollowHenyeyGreenstein) {
  for (const float g : {-0.7F, -5e-4F, 0.0F, 5e-4F, 2e-3F, 0.3F, 0.85F}) {
    constexpr int bins = 32;
    constexpr int samples = 100000;
    std::vector<double> seen(bins);
    for (int k = 0; k < samples; ++k) {
      const float u = uniform(random_bits(3, static_cast<std::uint64_t>(k)));
      const float c = sample_henyey_greenstein(g, u);
      ASSERT_LE(std::abs(c), 1);
      seen[static_cast<std::size_t>(std::min(static_cast<int>((c + 1) / 2 * bins), bins - 1))] += 1;
    }
    double chi_2 = 0;
    for (int b = 0; b < bins; ++b) {
      double expected = 0;
      constexpr int fine = 200;
      for (int k = 0; k < fine; ++k) {
        const float at = (static_cast<float>(b) + (static_cast<float>(k) + 0.5F) / fine) / bins;
        expected += static_cast<double>(henyey_greenstein(2 * at - 1, g));
      }
      expected *= 4 * pi_d / (bins * fine) * samples;
      chi_2 += std::pow(seen[static_cast<std::size_t>(b)] - expected, 2) / expected;
    }
    EXPECT_LT(chi_2, 31 + 5 * std::sqrt(2.0 * 31)) << g;
  }
}

}  // namespace
}  // namespace wold
