#include "erosion/realism.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "../terrain/testing.hpp"
#include "base/hash.hpp"
#include "base/parallel.hpp"
#include "erosion/realism_curves.hpp"

namespace wold {
namespace {

using testing_terrain::error_text;
using testing_terrain::field_of;
using testing_terrain::Steps;

Analysis analyzed(const Heightfield& field, const AnalysisOptions& options = {}) {
  Progress progress;
  return analyze(field, options, progress);
}

/// Waves along both axes with amplitudes k^(-slope / 2) and phases by chance.
Heightfield waves(int samples, double slope, int chance = 0) {
  const auto along = [&](int axis) {
    std::vector<double> sum(static_cast<std::size_t>(samples), 0.0);
    for (int k = 1; k < samples / 2; ++k) {
      const double phase = 2 * pi_d * uniform_double(random_bits(7, chance, axis, k));
      for (int i = 0; i < samples; ++i)
        sum[static_cast<std::size_t>(i)] +=
            100 * std::pow(k, -slope / 2) * std::cos(2 * pi_d * k * i / samples + phase);
    }
    return sum;
  };
  const std::vector<double> x = along(0);
  const std::vector<double> y = along(1);
  return field_of(samples, samples, 10, {}, [&](DVec2 p) {
    return x[static_cast<std::size_t>(std::lround(p.x / 10))] +
           y[static_cast<std::size_t>(std::lround(p.y / 10))];
  });
}

TEST(Realism, SpectrumOfWavesHasTheirSlope) {
  // One such field has few independent waves, and logarithms of chance powers lie low: the mean
  // power of many is fitted.
  for (const double slope : {1.5, 2.0, 2.6}) {
    constexpr int fields = 24;
    std::vector<CurvePoint> mean;
    for (int k = 0; k < fields; ++k) {
      const Analysis a = analyzed(waves(128, slope, k));
      if (mean.empty()) mean.resize(a.spectrum.size());
      for (std::size_t n = 0; n < mean.size(); ++n)
        mean[n] = {a.spectrum[n].x, mean[n].y + a.spectrum[n].y / fields, 1};
    }
    const auto outside = [](const CurvePoint& p) { return p.x < 1 / 320.0 || p.x > 1 / 80.0; };
    mean.erase(std::remove_if(mean.begin(), mean.end(), outside), mean.end());
    EXPECT_NEAR(fit_power(mean, 0).slope, -slope, 0.12) << slope;
  }
}

TEST(Realism, SpectrumIsInUnits) {
  // 3 m cos(2 π x / 160 m): the power integrates to half the square of the amplitude along rows,
  // and to 0 along columns; the points are means of both.
  const Heightfield field =
      field_of(256, 256, 10, {}, [](DVec2 p) { return 3 * std::cos(2 * pi_d * p.x / 160); });
  const Analysis a = analyzed(field);
  double peak = 0;
  double where = 0;
  for (const CurvePoint& p : a.spectrum)
    if (p.y > peak) {
      peak = p.y;
      where = p.x;
    }
  EXPECT_NEAR(where, 1 / 160.0, 0.0006);
  EXPECT_GT(peak, 100);
}

TEST(Realism, HypsometryOfAPyramid) {
  // Above relative height e lies the square of side 1 - e: a share (1 - e)², integral 1/3; the
  // heights have density 2 (1 - e), skewness 2 √2 / 5.
  const Heightfield pyramid = field_of(401, 401, 1, {}, [](DVec2 p) {
    return 200 - std::max(std::abs(p.x - 200), std::abs(p.y - 200));
  });
  const Analysis a = analyzed(pyramid);
  EXPECT_NEAR(a.realism.hypsometric_integral, 1 / 3.0, 0.005);
  EXPECT_NEAR(a.realism.skewness, 2 * std::sqrt(2) / 5, 0.01);
  for (const CurvePoint& p : a.hypsometry) EXPECT_NEAR(p.x, std::pow(1 - p.y, 2), 0.01) << p.y;
}

TEST(Realism, HeightsAndSlopesOfAPlane) {
  const Heightfield plane = field_of(101, 51, 10, {}, [](DVec2 p) { return 0.75 * p.x; });
  const Realism r = analyzed(plane).realism;
  EXPECT_NEAR(r.mean_slope, degrees(std::atan(0.75)), 1e-3);
  EXPECT_NEAR(r.median_slope, degrees(std::atan(0.75)), 1e-3);
  EXPECT_NEAR(r.steep_share, 1, 1e-9);
  EXPECT_NEAR(r.relief, 750, 1e-3);
  EXPECT_NEAR(r.deviation, 750 / std::sqrt(12.0) * std::sqrt(102.0 / 100), 1);
  EXPECT_NEAR(r.hypsometric_integral, 0.5, 1e-6);
  EXPECT_NEAR(r.skewness, 0, 1e-6);
  // Two columns of neighbours, 7.5 m above and below: 3 of each.
  EXPECT_NEAR(r.ruggedness, 7.5 * std::sqrt(6.0), 0.2);
  EXPECT_EQ(r.pits, 0);
  EXPECT_EQ(r.lake_share, 0);
}

/// A valley along x whose river, fed from both sides all along, has slope k A^-θ.
Heightfield graded_valley(double theta) {
  const int length = 400;
  const int width = 41;
  const double cell = 20;
  std::vector<double> bed(static_cast<std::size_t>(length), 0.0);
  for (int i = 1; i < length; ++i) {
    const double area = (length - i) * width * cell * cell;
    bed[static_cast<std::size_t>(i)] =
        bed[static_cast<std::size_t>(i - 1)] + cell * 0.05 * std::pow(area / 1e5, -theta);
  }
  return field_of(length, width, cell, {}, [&](DVec2 p) {
    return bed[static_cast<std::size_t>(p.x / cell)] + 0.5 * std::abs(p.y - 20 * cell);
  });
}

TEST(Realism, ConcavityOfGradedRivers) {
  for (const double theta : {0.3, 0.45, 0.6}) {
    const Analysis a = analyzed(graded_valley(theta), {.channel_area = 1e5});
    EXPECT_NEAR(a.realism.concavity, theta, 0.02 * theta) << theta;
    EXPECT_GT(a.realism.concavity_fit, 0.99);
  }
}

TEST(Realism, DrainageOfAValley) {
  const Analysis a = analyzed(graded_valley(0.45), {.channel_area = 1e5});
  EXPECT_EQ(a.realism.highest_order, 1);
  EXPECT_NEAR(a.realism.drainage_density, 8.0 / (8 * 0.82), 0.1);
}

TEST(Realism, HacksExponentOfAValley) {
  // After n samples of river, A ∝ n and L = (n + 20) cells with the way down the side: the exponent
  // is n / (n + 20), with n from 183 to 400.
  const Analysis a = analyzed(graded_valley(0.45), {.channel_area = 3e6});
  EXPECT_NEAR(a.realism.hack_exponent, 0.93, 0.02);
}

TEST(Realism, CountsPitsAndLakes) {
  Heightfield field = field_of(50, 50, 10, {}, [](DVec2 p) { return 0.1 * p.x; });
  field.height(20, 20) = 0;
  field.height(30, 31) = 5;
  const Realism r = analyzed(field).realism;
  EXPECT_EQ(r.pits, 2);
  EXPECT_NEAR(r.lake_share, 2 / 2500.0, 1e-9);
}

TEST(Realism, DifferenceOfTwoFields) {
  const auto land = [](int samples, double raised) {
    return field_of(samples, samples, 640.0 / (samples - 1), {}, [&](DVec2 p) {
      return 100 * std::sin(p.x / 90) * std::cos(p.y / 110) + raised;
    });
  };
  Progress progress;
  EXPECT_EQ(relative_difference(land(65, 0), land(65, 0), progress), 0);
  EXPECT_LT(relative_difference(land(65, 0), land(129, 0), progress), 0.005);
  EXPECT_NEAR(relative_difference(land(129, 10), land(65, 0), progress), 0.05, 0.006);
}

TEST(Realism, EveryFigureHasItsOwnNameAndText) {
  std::set<std::string> names;
  for (const Figure& figure : figures(analyzed(waves(32, 2)).realism)) {
    EXPECT_TRUE(names.insert(figure.name).second) << figure.name;
    EXPECT_FALSE(figure.text.empty());
    EXPECT_EQ(figure.has_range(), !figure.source.empty());
  }
}

TEST(Realism, SmallestGroundGivesNoNonsense) {
  const Realism r = analyzed(field_of(2, 5, 10, {}, [](DVec2 p) { return p.y; })).realism;
  EXPECT_TRUE(std::isnan(r.concavity));
  EXPECT_TRUE(std::isnan(r.spectrum_slope));
  EXPECT_EQ(r.pits, 0);
}

TEST(Realism, SameBitsForAnyNumberOfThreads) {
  Steps steps;
  steps.add("ridged");
  const Heightfield field = steps.evaluate({.resolution = 129}).field;
  const auto values = [&](int threads) {
    const ThreadLimit limit(threads);
    std::vector<double> out;
    for (const Figure& figure : figures(analyzed(field).realism)) out.push_back(figure.value);
    return out;
  };
  EXPECT_EQ(values(1), values(2));
  EXPECT_EQ(values(1), values(4));
}

TEST(Realism, ErrorsAndCancel) {
  Heightfield field = waves(16, 2);
  Progress progress;
  progress.cancel();
  error_text([&] { analyze(field, {}, progress); }, ErrorKind::cancelled);
  field.height(1, 2) = INFINITY;
  EXPECT_NE(error_text([&] { analyzed(field); }).find("(1, 2)"), std::string::npos);
}

}  // namespace
}  // namespace wold
